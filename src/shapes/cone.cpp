// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "shapes/registry.h"
#include "shapes/revolved_quadric.h"

namespace lampyris {

namespace {

struct ConeParameters {
  float radius = 1, height = 1, phiMax = 360;

  void declare(Declaration& d) {
    d.add("radius", radius, "Radius at z = 0.").atLeast(0);
    d.add("height", height, "z of the apex; nothing is there if it is not > 0.").clamped(0);
    d.add("phimax", phiMax, "Sweep about the z axis, in degrees.").clamped(0, 360);
  }
};

class Cone final : public RevolvedQuadric {
 public:
  Cone(const ConeParameters& p, const ShapeContext& context) : RevolvedQuadric(context, "cone") {
    const double radius = p.radius, height = std::max(0.f, p.height);
    const double slope = radius / height;
    Profile profile;
    profile.c0 = radius * radius;
    profile.c1 = -2 * radius * slope;
    profile.c2 = slope * slope;
    profile.zAt1 = height;
    profile.phiMax = sweepAngle(p.phiMax);
    finishProfile(profile,
                  height > 0 ? 0.5 * profile.phiMax * radius * std::hypot(radius, height) : 0);
  }

 protected:
  DVec2 sampleParameters(const Vec2& u) const override {
    return {u.x, 1 - std::sqrt(static_cast<double>(1 - u.y))};
  }
};

std::unique_ptr<Shape> create(const ConeParameters& p, const ShapeContext& context) {
  return std::make_unique<Cone>(p, context);
}

}  // namespace

ShapeRegistry::Entry conePlugin() {
  return makePlugin("cone", "Cone about the z axis, without its base.", create);
}

}  // namespace lampyris
