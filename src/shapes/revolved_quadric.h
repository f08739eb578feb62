// SPDX-License-Identifier: Apache-2.0
/// What cone, paraboloid and hyperboloid share: a curve turned about the z axis whose squared
/// radius is a quadratic function of z.
#pragma once

#include "shapes/quadric.h"

namespace lampyris {

/// Subclasses set the profile, then call finishProfile(). Conventions of pbrt-v3: v runs along z, u
/// about the axis from the azimuth at which the line of `start` and `end` stands.
class RevolvedQuadric : public Quadric {
 public:
  std::optional<ShapeHit> intersect(uint32_t element, const Ray& ray) const final;
  NormalCone normalCone(uint32_t element) const final { return (void)element, NormalCone{}; }

 protected:
  struct Profile {
    double c0 = 0, c1 = 0, c2 = 0;  ///< radius² = c0 + c1 z + c2 z²
    double zAt0 = 0, zAt1 = 0;      ///< z at v = 0 and v = 1
    DVec2 start{1, 0}, end{1, 0};   ///< at v = 0 and v = 1: azimuth of u = 0
    double phiMax = 0;              ///< sweep in radians
    double radius2(double z) const { return c0 + z * (c1 + z * c2); }
    double zMin() const { return std::min(zAt0, zAt1); }
    double zMax() const { return std::max(zAt0, zAt1); }
    double vOf(double z) const { return (z - zAt0) / (zAt1 - zAt0); }
  };

  using Quadric::Quadric;
  /// `area` of the swept surface; 0: nothing is there.
  void finishProfile(const Profile& profile, double area);
  const Profile& profile() const { return profile_; }
  Point evaluate(DVec2 uv) const final;

 private:
  Profile profile_;
  double smallRadius_ = 0;  ///< stands in for radii so close to the axis that directions vanish
};

}  // namespace lampyris
