// SPDX-License-Identifier: Apache-2.0
// Curves with a width, for hair, fur and grass. Elements are equal pieces of each segment: small
// boxes for the ray tracer.
#include <fmt/format.h>

#include <cmath>

#include "core/frame.h"
#include "shapes/curve_segment.h"
#include "shapes/quadric.h"
#include "shapes/registry.h"

namespace lampyris {

namespace {

struct CurveParameters {
  std::string type = "flat", basis = "bezier";
  int degree = 3;
  std::vector<Vec3> points, normals;
  float width = 1, splitDepth = 3;
  std::optional<float> startWidth, endWidth;

  void declare(Declaration& d) {
    d.add("type", type,
          "flat: turned to the ray; cylinder: the same with the normals of a tube; ribbon: turned "
          "by N.")
        .oneOf({"flat", "cylinder", "ribbon"});
    d.add("basis", basis, "Segments of Bézier curves, or a uniform B-spline.")
        .oneOf({"bezier", "bspline"});
    d.add("degree", degree, "2 or 3.").range(2, 3);
    d.add("P", points, "Control points.")
        .rangeIs("degree + 1 points and degree (bspline: 1) for each further segment");
    d.add("width", width, "Width from side to side.").atLeast(0);
    d.add("width0", startWidth, "Width at the start.").atLeast(0).defaultIs("width");
    d.add("width1", endWidth, "Width at the end.").atLeast(0).defaultIs("width");
    d.add("N", normals, "Normals of a ribbon: one for each end of a segment.")
        .type(ParameterType::Normal)
        .rangeIs("none, or segments + 1");
    d.add("splitdepth", splitDepth,
          "Each segment has 2^splitdepth boxes: faster rays for more memory. An integer.")
        .range(0, 10);
  }
};

/// Less than asked for where boxes would fill the memory.
uint32_t boundedDepth(float wanted, size_t segments) {
  constexpr size_t kMostElements = size_t{1} << 24;
  auto depth = static_cast<uint32_t>(wanted);
  while (depth > 0 && (segments << depth) > kMostElements) --depth;
  return depth;
}

class Curve final : public Shape {
 public:
  Curve(const CurveParameters& p, size_t segments, const ShapeContext& context)
      : toWorld_(context.objectToWorld),
        points_(p.points),
        normals_(p.normals),
        segments_(segments),
        degree_(static_cast<size_t>(p.degree)),
        splitDepth_(boundedDepth(p.splitDepth, segments)),
        startWidth_(p.startWidth.value_or(p.width)),
        endWidth_(p.endWidth.value_or(p.width)),
        basis_(p.basis == "bezier" ? CurveBasis::Bezier : CurveBasis::BSpline),
        isTube_(p.type == "cylinder"),
        reverse_(context.reverseOrientation) {}

  uint32_t elementCount() const override { return static_cast<uint32_t>(segments_ << splitDepth_); }
  Bounds3 bounds(uint32_t element) const override;
  std::optional<ShapeHit> intersect(uint32_t element, const Ray& ray) const override;
  /// Uses the ray: the strip is turned to it.
  void surface(uint32_t element, const ShapeHit& hit, const Ray& ray, SurfaceDetail detail,
               SurfaceInteraction& out) const override;
  /// An estimate: a strip that turns to whoever looks has no area.
  float area(uint32_t element) const override;
  /// Nothing: such a strip cannot be sampled; rays find its light.
  std::optional<ShapeSample> sampleArea(uint32_t, const Vec2&) const override {
    return std::nullopt;
  }
  float pdfArea(uint32_t, const Vec3&) const override { return 0; }
  NormalCone normalCone(uint32_t) const override { return {}; }

 private:
  struct Piece {
    CurveSegment segment;
    double u0, u1;
  };
  CurveSegment segment(size_t i) const;
  Piece piece(uint32_t element) const;
  void setTangents(const CurveSegment& s, const Vec2& uv, const DVec3& w, double width,
                   SurfaceInteraction& out) const;

  Transform toWorld_;
  std::vector<Vec3> points_, normals_;
  size_t segments_, degree_;
  uint32_t splitDepth_;
  double startWidth_, endWidth_;
  CurveBasis basis_;
  bool isTube_, reverse_;
};

CurveSegment Curve::segment(size_t i) const {
  const auto widthAt = [&](size_t end) {
    const double u = static_cast<double>(end) / static_cast<double>(segments_);
    return (1 - u) * startWidth_ + u * endWidth_;
  };
  CurveSegment s{curveSegment(points_, i, degree_, basis_), widthAt(i), widthAt(i + 1)};
  if (!normals_.empty()) {
    s.oriented = true;
    s.startNormal = normals_[i];
    s.endNormal = normals_[i + 1];
  }
  return s;
}

Curve::Piece Curve::piece(uint32_t element) const {
  const uint32_t pieces = 1u << splitDepth_, k = element & (pieces - 1);
  return {segment(element >> splitDepth_), static_cast<double>(k) / pieces,
          static_cast<double>(k + 1) / pieces};
}

Bounds3 Curve::bounds(uint32_t element) const {
  const Piece p = piece(element);
  const auto width = static_cast<float>(std::max(p.segment.width(p.u0), p.segment.width(p.u1)));
  Bounds3 b;
  for (const DVec3& c : p.segment.curve.piece(p.u0, p.u1).p) b.extend(Vec3(c));
  b.min -= Vec3(0.5f * width);
  b.max += Vec3(0.5f * width);
  return toWorld_.bounds(b);
}

std::optional<ShapeHit> Curve::intersect(uint32_t element, const Ray& ray) const {
  const Transform toObject = toWorld_.inverse();
  const DVec3 o(toObject.affinePoint(ray.o)), d(toObject.vector(ray.d));
  const double length = glm::length(d);
  if (!(length > 0)) return std::nullopt;
  const Piece p = piece(element);
  const auto hit = p.segment.intersect(p.u0, p.u1, o, d / length, length * ray.tMax);
  if (!hit) return std::nullopt;
  const auto t = static_cast<float>(hit->z / length);
  if (!(t > 0 && t < ray.tMax)) return std::nullopt;
  return ShapeHit{t, Vec2(hit->u, hit->v)};
}

void Curve::setTangents(const CurveSegment& s, const Vec2& uv, const DVec3& w, double width,
                        SurfaceInteraction& out) const {
  DVec3 along = s.curve.derivative(uv.x);
  if (along == DVec3(0)) along = s.curve.p[3] - s.curve.p[0];
  DVec3 across = glm::cross(s.oriented ? s.normal(uv.x) : w, along);
  if (!(glm::length(across) > 1e-9 * glm::length(along))) {  // seen along its direction
    Vec3 x, y;
    completeBasis(normalize(Vec3(along)), x, y);
    if (!(glm::length(along) > 0)) completeBasis(Vec3(w), x, y), along = DVec3(x);
    across = DVec3(y);
  }
  across *= width / glm::length(across);
  if (isTube_) {
    // From one side to the other the tube's normal turns by half a turn.
    const double angle = (0.5 - static_cast<double>(uv.y)) * static_cast<double>(kPi);
    across =
        std::cos(angle) * across + std::sin(angle) * glm::cross(along / glm::length(along), across);
  }
  out.dpdu = toWorld_.vector(Vec3(along));
  out.dpdv = toWorld_.vector(Vec3(across));
}

void Curve::surface(uint32_t element, const ShapeHit& hit, const Ray& ray, SurfaceDetail,
                    SurfaceInteraction& out) const {
  const CurveSegment s = segment(element >> splitDepth_);
  const DVec3 d(toWorld_.inverse().vector(ray.d));
  const DVec3 w = d / glm::length(d);
  const double width = s.widthSeen(hit.uv.x, w);
  out.p = ray.at(hit.t);
  out.uv = hit.uv;
  out.time = ray.time;
  setTangents(s, hit.uv, w, width, out);
  out.n = normalize(cross(out.dpdu, out.dpdv));
  if (out.n == Vec3(0)) out.n = normalize(-ray.d);
  if (reverse_) out.n = -out.n;
  // Rays that leave start two widths away, as in pbrt-v3, beyond the strip as any of them sees it
  // (offsetRayOrigin() takes twice the error).
  out.pError = toWorld_.pointError(Vec3(0), Vec3(static_cast<float>(width))) +
               roundingBound(4) * (absComponents(ray.o) + absComponents(hit.t * ray.d));
  out.dndu = out.dndv = Vec3(0);
  out.shading = {out.n, out.dpdu, out.dpdv, Vec3(0), Vec3(0)};
}

float Curve::area(uint32_t element) const {
  const Piece p = piece(element);
  const CubicBezier c = p.segment.curve.piece(p.u0, p.u1);
  double length = 0;
  for (size_t i = 0; i < 3; ++i)
    length += static_cast<double>(lampyris::length(toWorld_.vector(Vec3(c.p[i + 1] - c.p[i]))));
  const double scale = std::cbrt(std::abs(glm::determinant(glm::dmat3(toWorld_.matrix()))));
  return static_cast<float>(length * scale * p.segment.width(0.5 * (p.u0 + p.u1)));
}

void checkNormals(CurveParameters& p, size_t segments, const ShapeContext& context) {
  if (p.type != "ribbon") {
    if (!p.normals.empty())
      context.diagnostics.warn(context.location,
                               "curve: \"normal N\" counts for the type \"ribbon\" only");
    p.normals.clear();
    return;
  }
  if (p.normals.size() != segments + 1)
    throw SceneError(context.location,
                     fmt::format("curve: a ribbon of {} segments needs {} normals (\"normal N\"), "
                                 "got {}",
                                 segments, segments + 1, p.normals.size()));
  for (Vec3& n : p.normals) {
    n = normalize(n);
    if (n == Vec3(0))
      throw SceneError(context.location, "curve: \"normal N\" has a normal without direction");
  }
}

std::unique_ptr<Shape> create(const CurveParameters& parameters, const ShapeContext& context) {
  CurveParameters p = parameters;
  const auto basis = p.basis == "bezier" ? CurveBasis::Bezier : CurveBasis::BSpline;
  const size_t segments = curveSegmentCount(p.points.size(), static_cast<size_t>(p.degree), basis);
  if (segments == 0)
    throw SceneError(
        context.location,
        fmt::format("curve: {} control points (\"point P\"); degree {} wants {} and any multiple "
                    "of {} more",
                    p.points.size(), p.degree, p.degree + 1,
                    basis == CurveBasis::Bezier ? p.degree : 1));
  if (segments > size_t{1} << 20)
    throw SceneError(context.location, "curve: more than 1048576 segments; split the curve");
  for (const Vec3& v : p.points)
    if (!isFinite(context.objectToWorld.point(v)))
      throw SceneError(context.location, "curve: a control point is not finite");
  checkNormals(p, segments, context);
  return std::make_unique<Curve>(p, segments, context);
}

}  // namespace

ShapeRegistry::Entry curvePlugin() {
  return makePlugin("curve", "Curve with a width, for hair and grass.", create);
}

}  // namespace lampyris
