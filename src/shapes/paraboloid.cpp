// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "shapes/registry.h"
#include "shapes/revolved_quadric.h"

namespace lampyris {

namespace {

struct ParaboloidParameters {
  float radius = 1, zMin = 0, zMax = 1, phiMax = 360;

  void declare(Declaration& d) {
    d.add("radius", radius, "Radius at z = zmax. The apex is at z = 0.").atLeast(0);
    d.add("zmin", zMin, "Lower end along the z axis.").rangeIs("any; there is no surface below 0");
    d.add("zmax", zMax, "Upper end along the z axis.").rangeIs("any; there is no surface below 0");
    d.add("phimax", phiMax, "Sweep about the z axis, in degrees.").clamped(0, 360);
  }
};

/// radius² = z / k. A piece of it has an area of φ / (12 k²) · (1 + 4 k z)^(3/2), from its lower
/// end to its upper one.
class Paraboloid final : public RevolvedQuadric {
 public:
  Paraboloid(const ParaboloidParameters& p, const ShapeContext& context)
      : RevolvedQuadric(context, "paraboloid"),
        k_(std::max(p.zMin, p.zMax) / sqr(static_cast<double>(p.radius))) {
    Profile profile;
    profile.c1 = 1 / k_;
    profile.zAt0 = std::min(p.zMin, p.zMax);
    profile.zAt1 = std::max(p.zMin, p.zMax);
    profile.phiMax = sweepAngle(p.phiMax);
    begin_ = growth(profile.zAt0);
    end_ = growth(profile.zAt1);
    finishProfile(profile, profile.phiMax / (12 * k_ * k_) * std::abs(end_ - begin_));
  }

 protected:
  DVec2 sampleParameters(const Vec2& u) const override {
    const double w = begin_ + static_cast<double>(u.y) * (end_ - begin_);
    return {u.x, profile().vOf(std::expm1(2. / 3 * std::log1p(w)) / (4 * k_))};
  }

 private:
  /// (1 + 4 k z)^(3/2) − 1, precise for flat ones; 0 where there is no surface.
  double growth(double z) const { return std::expm1(1.5 * std::log1p(std::max(0., 4 * k_ * z))); }

  double k_, begin_ = 0, end_ = 0;
};

std::unique_ptr<Shape> create(const ParaboloidParameters& p, const ShapeContext& context) {
  return std::make_unique<Paraboloid>(p, context);
}

}  // namespace

ShapeRegistry::Entry paraboloidPlugin() {
  return makePlugin("paraboloid", "Paraboloid about the z axis, with its apex at 0.", create);
}

}  // namespace lampyris
