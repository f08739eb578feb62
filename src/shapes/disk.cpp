// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "core/sampling.h"
#include "shapes/quadric.h"
#include "shapes/registry.h"

namespace lampyris {

namespace {

struct DiskParameters {
  float height = 0, radius = 1, innerRadius = 0, phiMax = 360;

  void declare(Declaration& d) {
    d.add("height", height, "Position along the z axis.").any();
    d.add("radius", radius, "Outer radius.").atLeast(0);
    d.add("innerradius", innerRadius, "Radius of the hole.").atLeast(0);
    d.add("phimax", phiMax, "Sweep about the z axis, in degrees.").clamped(0, 360);
  }
};

class Disk final : public Quadric {
 public:
  Disk(const DiskParameters& p, const ShapeContext& context)
      : Quadric(context, "disk"),
        height_(p.height),
        radius_(p.radius),
        inner_(p.innerRadius),
        phiMax_(sweepAngle(p.phiMax)),
        full_(p.innerRadius == 0 && p.phiMax >= 360) {
    Extent extent;
    extent.area = std::max(0., 0.5 * phiMax_ * (radius_ * radius_ - inner_ * inner_));
    extent.axisRadius = radius_;
    extent.originRadius = std::hypot(radius_, height_);
    DVec2 lo, hi;
    arcBounds(radius_, phiMax_, lo, hi);
    extent.min = DVec3(glm::min(lo, DVec2(0)), height_);
    extent.max = DVec3(glm::max(hi, DVec2(0)), height_);
    finish(extent);
  }

  std::optional<ShapeHit> intersect(uint32_t element, const Ray& ray) const override {
    (void)element;
    if (isEmpty()) return std::nullopt;
    const ObjectRay r = toObject(ray);
    if (r.d.z == 0) return std::nullopt;
    const double exact = (height_ - r.o.z) / r.d.z;
    const auto t = static_cast<float>(exact);
    if (!(t > 0 && t < ray.tMax)) return std::nullopt;
    const DVec3 p = r.o + exact * r.d;
    const double r2 = p.x * p.x + p.y * p.y;
    if (r2 > radius_ * radius_ || r2 < inner_ * inner_) return std::nullopt;
    const double phi = azimuth(p.x, p.y);
    if (phi > phiMax_) return std::nullopt;
    return ShapeHit{t, Vec2(phi / phiMax_, vOf(std::sqrt(r2)))};
  }

  NormalCone normalCone(uint32_t element) const override {
    (void)element;
    if (isEmpty()) return {};
    return {sampleAt({0.5, 0.5}).n, 1};
  }

 protected:
  Point evaluate(DVec2 uv) const override {
    const double phi = uv.x * phiMax_, r = radius_ - uv.y * (radius_ - inner_);
    const DVec3 outward(std::cos(phi), std::sin(phi), 0);
    const DVec3 turned(-outward.y, outward.x, 0);
    Point at;
    at.p = r * outward + DVec3(0, 0, height_);
    // At the centre dpdu vanishes; a small circle around it stands in.
    at.dpdu = phiMax_ * std::max(r, 1e-5 * radius_) * turned;
    at.dpdv = (inner_ - radius_) * outward;
    return at;
  }

  DVec2 sampleParameters(const Vec2& u) const override {
    if (full_) {
      const Vec2 p = sampleConcentricDisk(u);
      const DVec2 q(p);
      return {azimuth(q.x, q.y) / phiMax_, 1 - std::min(1., glm::length(q))};
    }
    const double r2 =
        inner_ * inner_ + static_cast<double>(u.y) * (radius_ * radius_ - inner_ * inner_);
    return {u.x, vOf(safeSqrt(r2))};
  }

 private:
  double vOf(double r) const { return (radius_ - r) / (radius_ - inner_); }

  double height_, radius_, inner_, phiMax_;
  bool full_;
};

std::unique_ptr<Shape> create(const DiskParameters& p, const ShapeContext& context) {
  return std::make_unique<Disk>(p, context);
}

}  // namespace

ShapeRegistry::Entry diskPlugin() { return makePlugin("disk", "Flat disk or ring.", create); }

}  // namespace lampyris
