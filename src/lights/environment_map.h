// SPDX-License-Identifier: Apache-2.0
/// An image wrapped around the unit sphere: what an infinite light with a map emits.
#pragma once

#include <array>
#include <memory>

#include "core/sampling.h"
#include "lights/emission_image.h"

namespace lampyris {

/// Conventions of pbrt-v3: z is up, the image's top row lies at θ = 0, columns run with φ from +x
/// over +y; bilinear between the texels' centres, both axes wrap. Directions are unit and in the
/// light's space.
class EnvironmentMap {
 public:
  EnvironmentMap(std::shared_ptr<const EmissionImage> image, const Rgb& scale);

  Rgb radiance(const Vec3& w) const;
  /// A direction with density pdf(w); of measure zero at the poles.
  Vec3 sample(const Vec2& u) const;
  /// By solid angle; > 0 wherever radiance() is not black, but for the poles themselves.
  float pdf(const Vec3& w) const;
  /// Mean over the sphere.
  Rgb mean() const { return mean_; }
  /// Luminance of the irradiance on a surface with normal `n`, or on both its sides, by the nine
  /// spherical harmonics up to the second degree (Ramamoorthi and Hanrahan 2001): a few percent off
  /// for skies, up to a fifth of all light for a lone sun. Never less than 2% of π times the mean.
  float irradiance(const Vec3& n, bool bothSides) const;

 private:
  void buildTables();

  std::shared_ptr<const EmissionImage> image_;
  Rgb scale_;
  Rgb mean_;
  std::array<double, 9> harmonics_{};  ///< of the luminance
  Distribution2D distribution_;
};

}  // namespace lampyris
