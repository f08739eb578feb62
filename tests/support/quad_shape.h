// SPDX-License-Identifier: Apache-2.0
/// Parallelograms as a shape, for tests that need emitters and nothing else of a shape.
#pragma once

#include <utility>
#include <vector>

#include "base/shape.h"

namespace lampyris::test {

struct Quad {
  Vec3 corner{0}, e1{1, 0, 0}, e2{0, 1, 0};
};

/// One element a parallelogram; the normal is along cross(e1, e2).
class QuadShape final : public Shape {
 public:
  explicit QuadShape(std::vector<Quad> quads) : quads_(std::move(quads)) {}

  uint32_t elementCount() const override { return static_cast<uint32_t>(quads_.size()); }
  Bounds3 bounds(uint32_t i) const override {
    const Quad& q = quads_[i];
    Bounds3 b(q.corner, q.corner + q.e1 + q.e2);
    b.extend(q.corner + q.e1);
    b.extend(q.corner + q.e2);
    return b;
  }
  std::optional<ShapeHit> intersect(uint32_t i, const Ray& ray) const override {
    const Quad& q = quads_[i];
    const Vec3 n = cross(q.e1, q.e2);
    const float t = dot(n, q.corner - ray.o) / dot(n, ray.d);
    if (!(t > 0 && t < ray.tMax)) return std::nullopt;
    const Vec3 d = ray.at(t) - q.corner;
    const float area2 = dot(n, n);
    const float u = dot(cross(d, q.e2), n) / area2, v = dot(cross(q.e1, d), n) / area2;
    if (u < 0 || u > 1 || v < 0 || v > 1) return std::nullopt;
    return ShapeHit{t, {u, v}};
  }
  void surface(uint32_t i, const ShapeHit& hit, const Ray& ray, SurfaceDetail,
               SurfaceInteraction& out) const override {
    const Quad& q = quads_[i];
    out.p = q.corner + hit.uv.x * q.e1 + hit.uv.y * q.e2;
    out.n = out.shading.n = normal(i);
    out.uv = hit.uv;
    out.time = ray.time;
    out.dpdu = out.shading.dpdu = q.e1;
    out.dpdv = out.shading.dpdv = q.e2;
  }
  float area(uint32_t i) const override { return length(cross(quads_[i].e1, quads_[i].e2)); }
  std::optional<ShapeSample> sampleArea(uint32_t i, const Vec2& u) const override {
    const Quad& q = quads_[i];
    if (!(area(i) > 0)) return std::nullopt;
    ShapeSample s;
    s.p = q.corner + u.x * q.e1 + u.y * q.e2;
    s.n = normal(i);
    s.pdf = 1 / area(i);
    return s;
  }
  NormalCone normalCone(uint32_t i) const override { return {normal(i), 1}; }

 private:
  Vec3 normal(uint32_t i) const { return normalize(cross(quads_[i].e1, quads_[i].e2)); }
  std::vector<Quad> quads_;
};

}  // namespace lampyris::test
