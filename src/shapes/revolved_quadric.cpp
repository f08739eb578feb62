// SPDX-License-Identifier: Apache-2.0
#include "shapes/revolved_quadric.h"

#include <cmath>

namespace lampyris {

namespace {

double cross2(const DVec2& a, const DVec2& b) { return a.x * b.y - a.y * b.x; }

}  // namespace

void RevolvedQuadric::finishProfile(const Profile& profile, double area) {
  profile_ = profile;
  const double lo = profile.zMin(), hi = profile.zMax();
  double widest = std::max(profile.radius2(lo), profile.radius2(hi));
  const double bulge = -profile.c1 / (2 * profile.c2);
  if (bulge > lo && bulge < hi) widest = std::max(widest, profile.radius2(bulge));
  Extent extent;
  extent.axisRadius = std::sqrt(std::max(0., widest));
  smallRadius_ = 1e-7 * extent.axisRadius;
  if (area > 0 && std::isfinite(area) && std::isfinite(extent.axisRadius)) extent.area = area;
  extent.originRadius = std::hypot(extent.axisRadius, std::max(std::abs(lo), std::abs(hi)));
  DVec2 min(-extent.axisRadius), max(extent.axisRadius);
  if (profile.start == profile.end) {
    arcBounds(extent.axisRadius, profile.phiMax, min, max);
    min = glm::min(min, DVec2(0));
    max = glm::max(max, DVec2(0));
  }
  extent.min = DVec3(min, lo);
  extent.max = DVec3(max, hi);
  finish(extent);
}

std::optional<ShapeHit> RevolvedQuadric::intersect(uint32_t element, const Ray& ray) const {
  (void)element;
  if (isEmpty()) return std::nullopt;
  const ObjectRay r = toObject(ray);
  const Profile& p = profile_;
  // From the ray's point nearest to the shape's middle on: terms then have the size of the shape,
  // and distant rays lose nothing to the difference of large squares.
  const double square = glm::dot(r.d, r.d);
  if (!(square > 0)) return std::nullopt;
  const DVec3 middle(0, 0, 0.5 * (p.zAt0 + p.zAt1));
  const double nearest = glm::dot(middle - r.o, r.d) / square;
  const DVec3 o = r.o + nearest * r.d;

  const double a = r.d.x * r.d.x + r.d.y * r.d.y - p.c2 * r.d.z * r.d.z;
  const double halfB = o.x * r.d.x + o.y * r.d.y - r.d.z * (0.5 * p.c1 + p.c2 * o.z);
  const double c = o.x * o.x + o.y * o.y - p.radius2(o.z);
  const Roots roots = quadraticRoots(a, halfB, c, halfB * halfB - a * c);
  for (int i = 0; i < roots.count; ++i) {
    const auto t = static_cast<float>(nearest + roots.t[i]);
    if (!(t > 0 && t < ray.tMax)) continue;
    const DVec3 at = o + roots.t[i] * r.d;
    if (at.z < p.zMin() || at.z > p.zMax()) continue;
    const double v = p.vOf(at.z);
    const DVec2 line = p.start + v * (p.end - p.start), xy(at);
    const double phi = azimuth(glm::dot(line, xy), cross2(line, xy));
    if (phi > p.phiMax) continue;
    return ShapeHit{t, Vec2(phi / p.phiMax, v)};
  }
  return std::nullopt;
}

Quadric::Point RevolvedQuadric::evaluate(DVec2 uv) const {
  const Profile& p = profile_;
  const double height = p.zAt1 - p.zAt0, z = p.zAt0 + uv.y * height;
  // The azimuth of the line at v, and its change: its angular momentum over its squared distance.
  const DVec2 along = p.end - p.start, line = p.start + uv.y * along;
  const double distance2 = glm::dot(line, line);
  const double turn = distance2 > 0 ? cross2(line, along) / distance2 : 0;
  const double turnChange = distance2 > 0 ? -2 * turn * glm::dot(line, along) / distance2 : 0;
  const double phi = std::atan2(line.y, line.x) + uv.x * p.phiMax;

  const double radius = std::sqrt(std::max(0., p.radius2(z)));
  const double r = std::max(radius, smallRadius_);
  const double half = 0.5 * p.c1 + p.c2 * z;  // radius × its derivative by z
  const double rv = height * half / r;
  const double rvv = height * height * (p.c2 - sqr(half / r)) / r;
  const DVec3 outward(std::cos(phi), std::sin(phi), 0), around(-outward.y, outward.x, 0);
  Point at;
  at.p = radius * outward + DVec3(0, 0, z);
  at.n = glm::normalize(r * outward - DVec3(0, 0, half)) * (height < 0 ? -1. : 1.);
  at.dpdu = p.phiMax * r * around;
  at.dpdv = rv * outward + r * turn * around + DVec3(0, 0, height);
  at.dpduu = -p.phiMax * p.phiMax * r * outward;
  at.dpduv = p.phiMax * (rv * around - r * turn * outward);
  at.dpdvv = (rvv - r * turn * turn) * outward + (2 * rv * turn + r * turnChange) * around;
  return at;
}

}  // namespace lampyris
