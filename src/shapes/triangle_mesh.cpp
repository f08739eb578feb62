// SPDX-License-Identifier: Apache-2.0
#include "shapes/triangle_mesh.h"

#include <algorithm>
#include <limits>

#include "core/frame.h"
#include "core/prefetch.h"
#include "core/rejections.h"
#include "core/sampling.h"
#include "shapes/parallelogram.h"
#include "shapes/spherical_triangle.h"

namespace lampyris {

namespace {

using DVec3 = glm::dvec3;

Vec3 unit(const DVec3& v) {
  const double square = glm::dot(v, v);
  // Far faster in single precision, where that has the range.
  if (square > 1e-30 && square < 1e30) return Vec3(v) * (1 / std::sqrt(static_cast<float>(square)));
  return square > 0 ? Vec3(v * (1 / std::sqrt(square))) : Vec3(0);
}

Vec3 finiteOrZero(const Vec3& v) { return isFinite(v) ? v : Vec3(0); }

/// Inverts [uv0 − uv2, uv1 − uv2]: the derivatives by u and v of what has the differences d02, d12.
struct UvSolver {
  explicit UvSolver(const std::array<Vec2, 3>& uv) {
    const glm::dvec2 a = glm::dvec2(uv[0]) - glm::dvec2(uv[2]);
    const glm::dvec2 b = glm::dvec2(uv[1]) - glm::dvec2(uv[2]);
    const double determinant = a.x * b.y - a.y * b.x;
    // Relative to its terms: below this the differences of the floats say nothing of it.
    degenerate = !(std::abs(determinant) > 1e-7 * (std::abs(a.x * b.y) + std::abs(a.y * b.x)));
    if (degenerate) return;
    inverse = 1 / determinant;
    u = glm::dvec2(b.y, -a.y) * inverse;
    v = glm::dvec2(-b.x, a.x) * inverse;
  }
  Vec3 byU(const Vec3& d02, const Vec3& d12) const {
    return Vec3(u.x * DVec3(d02) + u.y * DVec3(d12));
  }
  Vec3 byV(const Vec3& d02, const Vec3& d12) const {
    return Vec3(v.x * DVec3(d02) + v.y * DVec3(d12));
  }

  bool degenerate;
  double inverse = 0;  ///< of the determinant
  glm::dvec2 u{0}, v{0};
};

}  // namespace

struct TriangleMesh::Corners {
  const uint32_t* index;
  const Vec3 &p0, &p1, &p2;  ///< not copied: what is stored in pieces and read as a whole stalls

  /// Twice the area along the normal. In double: slivers keep their direction.
  DVec3 areaNormal() const { return glm::cross(DVec3(p1) - DVec3(p0), DVec3(p2) - DVec3(p0)); }
  /// By the edges, so that far from the origin the point is on the plane but for its own rounding.
  Vec3 point(const Vec3& b) const { return p0 + (b.y * (p1 - p0) + b.z * (p2 - p0)); }
  /// That rounding, and what is proportional to the distance from p0: this sum's errors and the ray
  /// tracer's.
  Vec3 pointError(const Vec3& b) const {
    return roundingBound(2) * absComponents(point(b)) +
           roundingBound(7) * (b.y * absComponents(p1 - p0) + b.z * absComponents(p2 - p0));
  }
};

/// A triangle in relation to a point from which it is sampled.
struct TriangleMesh::View {
  View(const Corners& c, const Vec3& from)
      : a(DVec3(c.p0) - DVec3(from)),
        e1(DVec3(c.p1) - DVec3(c.p0)),
        e2(DVec3(c.p2) - DVec3(c.p0)),
        areaNormal(glm::cross(e1, e2)),
        volume(std::abs(glm::dot(areaNormal, a))) {}

  /// Whether the edges from a corner are long against the distance of the centroid. Sampling and
  /// density both ask this.
  bool isWide() const {
    const DVec3 centre = 3. * a + e1 + e2;
    return 9 * (glm::dot(e1, e1) + glm::dot(e2, e2)) > kWide * glm::dot(centre, centre);
  }
  SphericalTriangle spherical() const {
    return {SeenCorner(a), SeenCorner(a + e1), SeenCorner(a + e2), volume};
  }
  /// By solid angle at distance `d`, of points that are uniform by area: d² / (cos θ · area). The
  /// distance from the plane stands for d cos θ, where rounding of the point would decide.
  float uniformPdf(float d) const {
    const double distance = d;
    return static_cast<float>(2 * distance * distance * distance / volume);
  }

  DVec3 a, e1, e2, areaNormal;
  double volume;
};

TriangleMesh::TriangleMesh(TriangleMeshData data, const Transform& objectToWorld,
                           bool reverseOrientation)
    : data_(std::move(data)),
      vertexCount_(data_.positions.size()),
      reverse_(reverseOrientation),
      flip_(reverseOrientation != objectToWorld.swapsHandedness()) {
  for (Vec3& p : data_.positions) p = objectToWorld.point(p);
  // Not made unit: as in pbrt-v3 their lengths weigh in the interpolation.
  for (Vec3& n : data_.normals) n = finiteOrZero(objectToWorld.normal(n));
  for (Vec3& s : data_.tangents) s = finiteOrZero(objectToWorld.vector(s));
  data_.positions.emplace_back(0);
  data_.positions.shrink_to_fit();
}

TriangleMesh::Corners TriangleMesh::corners(uint32_t element) const {
  const uint32_t* i = &data_.indices[3 * static_cast<size_t>(element)];
  return {i, data_.positions[i[0]], data_.positions[i[1]], data_.positions[i[2]]};
}

std::array<Vec2, 3> TriangleMesh::uvs(const Corners& c) const {
  if (data_.uvs.empty()) return {Vec2(0, 0), Vec2(1, 0), Vec2(1, 1)};
  return {data_.uvs[c.index[0]], data_.uvs[c.index[1]], data_.uvs[c.index[2]]};
}

Bounds3 TriangleMesh::bounds(uint32_t element) const {
  const Corners c = corners(element);
  Bounds3 b(c.p0, c.p1);
  b.extend(c.p2);
  return b;
}

std::optional<ShapeHit> TriangleMesh::intersect(uint32_t element, const Ray& ray) const {
  const Corners c = corners(element);
  const DVec3 o(ray.o), d(ray.d);
  const DVec3 a = DVec3(c.p0) - o, b = DVec3(c.p1) - o, e = DVec3(c.p2) - o;
  // Signed volumes with each edge (Plücker coordinates).
  const double w0 = glm::dot(d, glm::cross(e, b));
  const double w1 = glm::dot(d, glm::cross(a, e));
  const double w2 = glm::dot(d, glm::cross(b, a));
  if ((w0 < 0 || w1 < 0 || w2 < 0) && (w0 > 0 || w1 > 0 || w2 > 0)) return std::nullopt;
  const double sum = w0 + w1 + w2;
  const DVec3 n = c.areaNormal();
  const double cosine = glm::dot(n, d);
  if (sum == 0 || cosine == 0) return std::nullopt;
  const float t = static_cast<float>(glm::dot(n, a) / cosine);
  if (!(t > 0 && t < ray.tMax)) return std::nullopt;
  return ShapeHit{t, {static_cast<float>(w1 / sum), static_cast<float>(w2 / sum)}};
}

/// Zero without vertex normals.
inline Vec3 TriangleMesh::interpolatedNormal(const Corners& c, const Vec3& b) const {
  if (data_.normals.empty()) return Vec3(0);
  const Vec3 n = b.x * data_.normals[c.index[0]] + b.y * data_.normals[c.index[1]] +
                 b.z * data_.normals[c.index[2]];
  return reverse_ ? -n : n;
}

/// Vertex normals decide the side, else the order of the vertices; zero for a degenerate triangle.
inline Vec3 TriangleMesh::orientedNormal(const DVec3& areaNormal, const Vec3& vertexNormal) const {
  const Vec3 n = unit(areaNormal);
  if (vertexNormal != Vec3(0)) return faceForward(n, vertexNormal);
  return flip_ ? -n : n;
}

struct TriangleMesh::Parameters {
  Vec2 uv;
  Vec3 dpdu, dpdv;
  bool valid;  ///< false: uv does not parameterise the triangle
};

inline TriangleMesh::Parameters TriangleMesh::parameters(const Corners& c, const Vec3& b,
                                                         const DVec3& areaNormal) const {
  double across = glm::dot(areaNormal, areaNormal);  // |dpdu × dpdv|²
  Parameters out;
  if (data_.uvs.empty()) {  // the solution for the uv that stand in
    out = {Vec2(b.y + b.z, b.z), c.p1 - c.p0, c.p2 - c.p1, true};
  } else {
    const auto uv = uvs(c);
    const UvSolver solver(uv);
    out = {b.x * uv[0] + b.y * uv[1] + b.z * uv[2], solver.byU(c.p0 - c.p2, c.p1 - c.p2),
           solver.byV(c.p0 - c.p2, c.p1 - c.p2), !solver.degenerate};
    across *= sqr(solver.inverse);
  }
  // The sine of their angle against what rounding makes of it; false for what is not finite, too.
  const DVec3 du(out.dpdu), dv(out.dpdv);
  constexpr double kLeastSine2 = sqr(static_cast<double>(roundingBound(8)));
  out.valid = out.valid && across > kLeastSine2 * (glm::dot(du, du) * glm::dot(dv, dv));
  return out;
}

void TriangleMesh::surface(uint32_t element, const ShapeHit& hit, const Ray& ray,
                           SurfaceDetail detail, SurfaceInteraction& out) const {
  const Corners c = corners(element);
  // All that lies elsewhere at once: waiting for one after the other takes as long as the rest.
  if (!data_.normals.empty())
    for (size_t i = 0; i < 3; ++i) prefetchLine(&data_.normals[c.index[i]]);
  const Vec3 b(1 - hit.uv.x - hit.uv.y, hit.uv.x, hit.uv.y);
  out.p = c.point(b);
  out.pError = c.pointError(b);
  out.time = ray.time;
  out.dndu = out.dndv = out.shading.dndu = out.shading.dndv = Vec3(0);

  const DVec3 areaNormal = c.areaNormal();
  const Vec3 vertexNormal = interpolatedNormal(c, b);
  Vec3 n = orientedNormal(areaNormal, vertexNormal);
  // A ray tracer may report the edge of a triangle without area; it has no normal of its own.
  if (n == Vec3(0)) n = normalize(-ray.d);
  Parameters by = parameters(c, b, areaNormal);
  if (!by.valid) completeBasis(n, by.dpdu, by.dpdv);
  out.uv = by.uv;
  out.n = out.shading.n = n;
  out.dpdu = out.shading.dpdu = by.dpdu;
  out.dpdv = out.shading.dpdv = by.dpdv;

  if (!data_.normals.empty() || !data_.tangents.empty()) setShadingFrame(c, b, vertexNormal, out);
  if (detail == SurfaceDetail::Full && !data_.normals.empty())
    setNormalDerivatives(c, vertexNormal, out);
}

/// Shading normal and tangents of unit length, made orthogonal, such that cross(dpdu, dpdv) is the
/// shading normal. As in pbrt-v3 both tangents point against the parameterisation, which decides
/// the side to which bump maps bulge.
void TriangleMesh::setShadingFrame(const Corners& c, const Vec3& b, const Vec3& vertexNormal,
                                   SurfaceInteraction& out) const {
  const Vec3 unitNormal = normalize(vertexNormal);
  if (unitNormal != Vec3(0)) out.shading.n = unitNormal;
  Vec3 ss(0);
  if (!data_.tangents.empty()) {
    ss = normalize(b.x * data_.tangents[c.index[0]] + b.y * data_.tangents[c.index[1]] +
                   b.z * data_.tangents[c.index[2]]);
  }
  if (ss == Vec3(0)) ss = out.dpdu;
  const Vec3 ns = out.shading.n;
  const Vec3 ts = normalize(cross(ss, ns));
  if (ts == Vec3(0)) {
    completeBasis(ns, out.shading.dpdu, out.shading.dpdv);
  } else {
    out.shading.dpdu = cross(ts, ns);
    out.shading.dpdv = ts;
  }
}

void TriangleMesh::setNormalDerivatives(const Corners& c, const Vec3& vertexNormal,
                                        SurfaceInteraction& out) const {
  UvSolver solver(uvs(c));
  // Without a parameterisation: by the arbitrary frame that stands in for it.
  if (solver.degenerate) {
    solver = UvSolver({Vec2(dot(c.p0 - c.p2, out.dpdu), dot(c.p0 - c.p2, out.dpdv)),
                       Vec2(dot(c.p1 - c.p2, out.dpdu), dot(c.p1 - c.p2, out.dpdv)), Vec2(0)});
  }
  const Vec3 d02 = data_.normals[c.index[0]] - data_.normals[c.index[2]];
  const Vec3 d12 = data_.normals[c.index[1]] - data_.normals[c.index[2]];
  // The derivative of N / |N|.
  const float scale = (reverse_ ? -1.f : 1.f) / length(vertexNormal);
  const auto project = [&](const Vec3& v) {
    return scale * (v - dot(out.shading.n, v) * out.shading.n);
  };
  const Vec3 dndu = project(solver.byU(d02, d12)), dndv = project(solver.byV(d02, d12));
  if (!isFinite(dndu) || !isFinite(dndv)) return;
  out.shading.dndu = dndu;
  out.shading.dndv = dndv;
}

float TriangleMesh::area(uint32_t element) const {
  const Corners c = corners(element);
  const auto a = static_cast<float>(0.5 * glm::length(c.areaNormal()));
  // 1 / area is a density: it has to be finite.
  return a >= std::numeric_limits<float>::min() && std::isfinite(a) ? a : 0.f;
}

std::optional<ShapeSample> TriangleMesh::sampleArea(uint32_t element, const Vec2& u) const {
  const float a = area(element);
  if (!(a > 0)) return std::nullopt;
  const Corners c = corners(element);
  const Vec2 b01 = sampleUniformTriangle(u);
  const Vec3 b(b01.x, b01.y, std::max(0.f, 1 - b01.x - b01.y));
  ShapeSample s;
  s.p = c.point(b);
  s.pError = c.pointError(b);
  s.n = orientedNormal(c.areaNormal(), interpolatedNormal(c, b));
  s.pdf = 1 / a;
  return s;
}

std::optional<ShapeHit> TriangleMesh::locate(uint32_t element, const Vec3& p, const Vec3&) const {
  const Corners c = corners(element);
  const DVec3 e1 = DVec3(c.p1) - DVec3(c.p0), e2 = DVec3(c.p2) - DVec3(c.p0);
  const DVec3 n = glm::cross(e1, e2), d = DVec3(p) - DVec3(c.p0);
  const double square = glm::dot(n, n);
  if (!(square > 0)) return std::nullopt;
  // Rounding may have put p a little outside.
  const double b1 = std::clamp(glm::dot(glm::cross(d, e2), n) / square, 0., 1.);
  const double b2 = std::clamp(glm::dot(glm::cross(e1, d), n) / square, 0., 1. - b1);
  return ShapeHit{0, {static_cast<float>(b1), static_cast<float>(b2)}};
}

std::optional<ShapeSample> TriangleMesh::sampleSolidAngle(uint32_t element, const Vec3& from,
                                                          const Vec2& u) const {
  std::optional<ShapeSample> out;
  const Corners c = corners(element);
  const View view(c, from);
  if (!(view.volume > 0)) return out;  // seen edge on
  Vec3 b, p;
  float pdf;
  if (view.isWide()) {
    const SphericalTriangle seen = view.spherical();
    const float whole = seen.solidAngle();
    pdf = 1 / whole;
    b = seen.sample(HalfAngle::ofSolidAngle(u.x * whole), u.y);
    p = c.point(b);
  } else {
    const Vec2 b01 = sampleUniformTriangle(u);
    b = Vec3(b01.x, b01.y, std::max(0.f, 1 - b01.x - b01.y));
    p = c.point(b);
    pdf = view.uniformPdf(distance(p, from));
  }
  if (!(pdf > 0) || !std::isfinite(pdf)) {
    countRejection(Rejection::LightDensity);
    return out;
  }
  ShapeSample& s = out.emplace();
  s.p = p;
  s.pError = c.pointError(b);
  s.n = orientedNormal(view.areaNormal, interpolatedNormal(c, b));
  s.pdf = pdf;
  return out;
}

float TriangleMesh::pdfSolidAngle(uint32_t element, const Vec3& from, const Vec3& p,
                                  const Vec3&) const {
  const View view(corners(element), from);
  const float pdf =
      view.isWide() ? 1 / view.spherical().solidAngle() : view.uniformPdf(distance(p, from));
  return std::isfinite(pdf) ? pdf : 0;
}

Shape::NormalCone TriangleMesh::normalCone(uint32_t element) const {
  const Corners c = corners(element);
  const Vec3 n = unit(c.areaNormal());
  if (n == Vec3(0)) return {};
  if (data_.normals.empty()) return {flip_ ? -n : n, 1};
  const float d0 = dot(n, interpolatedNormal(c, {1, 0, 0}));
  const float d1 = dot(n, interpolatedNormal(c, {0, 1, 0}));
  const float d2 = dot(n, interpolatedNormal(c, {0, 0, 1}));
  if (d0 > 0 && d1 > 0 && d2 > 0) return {n, 1};
  if (d0 < 0 && d1 < 0 && d2 < 0) return {-n, 1};
  // Vertex normals on both sides: so is the interpolated one, and with it the geometric normal.
  return {n, -1};
}

/// Two triangles with one diagonal, the same front, and no vertex normals that bend the sides.
std::unique_ptr<const SampledSurface> TriangleMesh::whole() const {
  if (triangleCount() != 2) return nullptr;
  const NormalCone front = normalCone(0), other = normalCone(1);
  if (front.cosTheta != 1 || other.cosTheta != 1 || !(dot(front.axis, other.axis) > 0))
    return nullptr;
  const Corners c = corners(0), d = corners(1);
  const std::array<Vec3, 3> first{c.p0, c.p1, c.p2}, second{d.p0, d.p1, d.p2};
  const auto isIn = [](const std::array<Vec3, 3>& all, const Vec3& p) {
    return std::find(all.begin(), all.end(), p) != all.end();
  };
  std::array<Vec3, 4> around;
  size_t shared = 0;
  for (size_t i = 0; i < 3; ++i) {
    if (!isIn(second, first[i]))
      around = {first[(i + 2) % 3], first[i], first[(i + 1) % 3], Vec3()};
    shared += isIn(second, first[i]);
  }
  if (shared != 2) return nullptr;
  for (const Vec3& p : second)
    if (!isIn(first, p)) around[3] = p;
  return Parallelogram::make(around, front.axis);
}

}  // namespace lampyris
