// SPDX-License-Identifier: Apache-2.0
#include "stress/double_scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ostream>

#include "core/math.h"

namespace lampyris::test {
namespace {

std::string number(double v) { return fmt::format("{:.9g}", static_cast<float>(v)); }
std::string point(const DVec3& p) {
  return number(p.x) + " " + number(p.y) + " " + number(p.z) + "  ";
}
std::string grey(double v) { return number(v) + " " + number(v) + " " + number(v); }

std::string mesh(const DVec3& a, const DVec3& b, const DVec3& c) {
  return "Shape \"trianglemesh\" \"integer indices\" [0 1 2] \"point P\" [" + point(a) + point(b) +
         point(c) + "]\n";
}
std::string emitter(double radiance) {
  return radiance > 0 ? "AreaLightSource \"diffuse\" \"rgb L\" [" + grey(radiance) + "]\n" : "";
}

/// The distance at which a ray meets a triangle, or none (Möller and Trumbore 1997).
bool meets(const DVec3& o, const DVec3& d, const DTriangle& t, double least, double most) {
  const DVec3 e1 = t.b - t.a, e2 = t.c - t.a, h = glm::cross(d, e2);
  const double det = glm::dot(e1, h);
  if (det == 0) return false;
  const DVec3 s = o - t.a, q = glm::cross(s, e1);
  const double u = glm::dot(s, h) / det, v = glm::dot(d, q) / det, at = glm::dot(e2, q) / det;
  return u >= 0 && v >= 0 && u + v <= 1 && at > least && at < most;
}
bool meets(const DVec3& o, const DVec3& d, const DBall& b, double least, double most) {
  const DVec3 s = o - b.centre;
  const double a = glm::dot(d, d), h = glm::dot(s, d), c = glm::dot(s, s) - b.radius * b.radius;
  const double root = h * h - a * c;
  if (root < 0) return false;
  for (const double t : {(-h - std::sqrt(root)) / a, (-h + std::sqrt(root)) / a})
    if (t > least && t < most) return true;
  return false;
}

}  // namespace

DVec3 Place::operator()(const DVec3& p) const { return DVec3(Vec3(scale * (p + offset))); }

DVec3 Place::rounding(const DVec3& p) const {
  const Vec3 at = glm::abs(Vec3((*this)(p))) + length(1);
  return DVec3(Vec3(nextFloatUp(at.x), nextFloatUp(at.y), nextFloatUp(at.z))) - DVec3(at);
}

void PrintTo(const Place& place, std::ostream* out) {
  *out << fmt::format("scale {} at {} {} {}", place.scale, place.offset.x, place.offset.y,
                      place.offset.z);
}

void DScene::addQuad(const DVec3& corner, const DVec3& e1, const DVec3& e2, double radiance) {
  triangles.push_back({corner, corner + e1, corner + e1 + e2, radiance});
  triangles.push_back({corner, corner + e1 + e2, corner + e2, radiance});
}

DScene DScene::placed(const Place& place) const {
  DScene s = *this;
  for (DTriangle& t : s.triangles) t.a = place(t.a), t.b = place(t.b), t.c = place(t.c);
  for (DBall& b : s.balls) b.centre = place(b.centre), b.radius = place.length(b.radius);
  for (DLamp& l : s.lamps) {
    l.at = place(l.at);
    l.intensity = static_cast<float>(l.intensity * place.scale * place.scale);
  }
  return s;
}

std::string DScene::text(TinyView view, const Place& place) const {
  view.lookAt = point(place({0, 0, eye})) + point(place(DVec3(0))) + " 0 1 0";
  const std::string window = number(1e-6 * place.scale);
  view.camera = "\"orthographic\" \"float screenwindow\" [-" + window + " " + window + " -" +
                window + " " + window + "]";
  std::string world = "Material \"matte\" \"rgb Kd\" [" + grey(albedo) + "]\n";
  const double w = floor;
  world += mesh(place({-w, -w, 0}), place({w, -w, 0}), place({w, w, 0}));
  world += mesh(place({-w, -w, 0}), place({w, w, 0}), place({-w, w, 0}));
  world += "Material \"matte\" \"rgb Kd\" [0 0 0]\n";
  for (const DTriangle& t : triangles)
    world += "AttributeBegin\n" + emitter(t.radiance) + mesh(t.a, t.b, t.c) + "AttributeEnd\n";
  for (const DBall& b : balls)
    world += "AttributeBegin\n" + emitter(b.radiance) + "Translate " + point(b.centre) +
             "\nShape \"sphere\" \"float radius\" " + number(b.radius) + "\nAttributeEnd\n";
  for (const DLamp& l : lamps)
    world += "LightSource \"point\" \"point from\" [" + point(l.at) + "] \"rgb I\" [" +
             grey(l.intensity) + "]\n";
  return tinyScene(view, world);
}

bool DScene::isBlocked(const DVec3& from, const DVec3& to, const void* emitter) const {
  constexpr double kNear = 1e-9, kFar = 1 - 1e-9;
  const DVec3 d = to - from;
  for (const DTriangle& t : triangles)
    if (&t != emitter && meets(from, d, t, kNear, kFar)) return true;
  for (const DBall& b : balls)
    if (&b != emitter && meets(from, d, b, kNear, kFar)) return true;
  return false;
}

double DScene::irradiance(const DVec3& p, int cells) const {
  double sum = 0;
  // Of an area at `q` that faces along `n`; n = 0: of a point.
  const auto arriving = [&](const DVec3& q, const DVec3& n, const void* emitter) {
    const DVec3 d = q - p;
    const double d2 = glm::dot(d, d), length = std::sqrt(d2);
    if (!(d.z > 0) || isBlocked(p, q, emitter)) return 0.;
    const double facing = n == DVec3(0) ? 1 : std::max(0., -glm::dot(n, d) / length);
    return facing * d.z / (d2 * length);
  };
  for (const DLamp& l : lamps) sum += l.intensity * arriving(l.at, DVec3(0), nullptr);
  for (const DTriangle& t : triangles) {
    if (!(t.radiance > 0)) continue;
    const DVec3 e1 = t.b - t.a, e2 = t.c - t.a, n = glm::cross(e1, e2);
    const double area2 = glm::length(n);
    double part = 0;
    for (int i = 0; i < cells; ++i)
      for (int j = 0; i + j < cells; ++j) {
        // The halves of a grid's cells, at their centroids; the last of a row has one.
        const auto at = [&](double s) { return t.a + (i + s) / cells * e1 + (j + s) / cells * e2; };
        part += arriving(at(1. / 3), n / area2, &t);
        if (i + j + 1 < cells) part += arriving(at(2. / 3), n / area2, &t);
      }
    sum += t.radiance * part * area2 / (2. * cells * cells);
  }
  for (const DBall& b : balls) {
    if (!(b.radiance > 0)) continue;
    const DVec3 axis = b.centre - p;
    const double d2 = glm::dot(axis, axis), sin2 = b.radius * b.radius / d2;
    const DVec3 z = axis / std::sqrt(d2);
    const DVec3 x =
        glm::normalize(glm::cross(z, std::abs(z.x) < 0.5 ? DVec3(1, 0, 0) : DVec3(0, 1, 0)));
    const DVec3 y = glm::cross(z, x);
    double part = 0;
    for (int i = 0; i < cells; ++i)
      for (int j = 0; j < cells; ++j) {
        // sin² evenly: dω = d(sin²) dφ / (2 cos).
        const double s2 = sin2 * (i + 0.5) / cells, phi = 2 * M_PI * (j + 0.5) / cells;
        const double c = std::sqrt(1 - s2), s = std::sqrt(s2);
        const DVec3 w = s * std::cos(phi) * x + s * std::sin(phi) * y + c * z;
        const double t = std::sqrt(d2) * (c - std::sqrt(std::max(0., sin2 - s2)));
        if (w.z > 0 && !isBlocked(p, p + t * w, &b)) part += w.z / (2 * c);
      }
    sum += b.radiance * part * sin2 * 2 * M_PI / (cells * cells);
  }
  return sum;
}

Expected expectedRadiance(const DScene& placed, const Place& place, int cells) {
  const DVec3 p = place(DVec3(0));
  const double factor = static_cast<double>(static_cast<float>(placed.albedo)) / M_PI;
  const double e = placed.irradiance(p, cells), coarse = placed.irradiance(p, cells / 2);
  // The point is rounded, in any direction.
  double moved = 0;
  for (int axis = 0; axis < 3; ++axis) {
    DVec3 d(0);
    d[axis] = place.rounding(DVec3(0))[axis];
    for (const double side : {-1., 1.})
      moved += std::abs(placed.irradiance(p + side * d, cells / 2) - coarse) / 2;
  }
  return {factor * e, factor * (moved + std::abs(e - coarse) + 2e-5 * e)};
}

}  // namespace lampyris::test
