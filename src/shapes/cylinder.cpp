// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "shapes/quadric.h"
#include "shapes/registry.h"

namespace lampyris {

namespace {

struct CylinderParameters {
  float radius = 1, zMin = -1, zMax = 1, phiMax = 360;

  void declare(Declaration& d) {
    d.add("radius", radius, "Radius.").atLeast(0);
    d.add("zmin", zMin, "Lower end along the z axis.").any();
    d.add("zmax", zMax, "Upper end along the z axis.").any();
    d.add("phimax", phiMax, "Sweep about the z axis, in degrees.").clamped(0, 360);
  }
};

class Cylinder final : public Quadric {
 public:
  Cylinder(const CylinderParameters& p, const ShapeContext& context)
      : Quadric(context, "cylinder"),
        radius_(p.radius),
        zMin_(std::min(p.zMin, p.zMax)),
        zMax_(std::max(p.zMin, p.zMax)),
        phiMax_(sweepAngle(p.phiMax)) {
    Extent extent;
    extent.area = phiMax_ * radius_ * (zMax_ - zMin_);
    extent.axisRadius = radius_;
    extent.originRadius = std::hypot(radius_, std::max(std::abs(zMin_), std::abs(zMax_)));
    DVec2 lo, hi;
    arcBounds(radius_, phiMax_, lo, hi);
    extent.min = DVec3(lo, zMin_);
    extent.max = DVec3(hi, zMax_);
    finish(extent);
  }

  std::optional<ShapeHit> intersect(uint32_t element, const Ray& ray) const override {
    (void)element;
    if (isEmpty()) return std::nullopt;
    const ObjectRay r = toObject(ray);
    // As for the sphere, in the plane across the axis.
    const DVec2 o(r.o), d(r.d);
    const double a = glm::dot(d, d), halfB = glm::dot(o, d);
    if (!(a > 0)) return std::nullopt;
    const DVec2 foot = o - (halfB / a) * d;
    const double far = glm::length(o);
    const Roots roots = quadraticRoots(a, halfB, (far - radius_) * (far + radius_),
                                       a * (radius_ * radius_ - glm::dot(foot, foot)));
    for (int i = 0; i < roots.count; ++i) {
      const auto t = static_cast<float>(roots.t[i]);
      if (!(t > 0 && t < ray.tMax)) continue;
      const DVec3 p = r.o + roots.t[i] * r.d;
      const double phi = azimuth(p.x, p.y);
      if (p.z < zMin_ || p.z > zMax_ || phi > phiMax_) continue;
      return ShapeHit{t, Vec2(phi / phiMax_, (p.z - zMin_) / (zMax_ - zMin_))};
    }
    return std::nullopt;
  }

  NormalCone normalCone(uint32_t element) const override { return (void)element, NormalCone{}; }

 protected:
  Point evaluate(DVec2 uv) const override {
    const double phi = uv.x * phiMax_;
    const DVec3 outward(std::cos(phi), std::sin(phi), 0);
    Point at;
    at.n = outward;
    at.p = radius_ * outward + DVec3(0, 0, zMin_ + uv.y * (zMax_ - zMin_));
    at.dpdu = phiMax_ * radius_ * DVec3(-outward.y, outward.x, 0);
    at.dpdv = DVec3(0, 0, zMax_ - zMin_);
    at.dpduu = -phiMax_ * phiMax_ * radius_ * outward;
    return at;
  }
  DVec2 sampleParameters(const Vec2& u) const override { return DVec2(u); }

 private:
  double radius_, zMin_, zMax_, phiMax_;
};

std::unique_ptr<Shape> create(const CylinderParameters& p, const ShapeContext& context) {
  return std::make_unique<Cylinder>(p, context);
}

}  // namespace

ShapeRegistry::Entry cylinderPlugin() {
  return makePlugin("cylinder", "Cylinder about the z axis, without caps.", create);
}

}  // namespace lampyris
