// SPDX-License-Identifier: Apache-2.0
/// Light scattered by a hair, seen from afar: Chiang et al. 2016, "A Practical and Controllable
/// Hair and Fur Model for Production Path Tracing", with the longitudinal lobes of d'Eon et al.
/// 2011, "An Energy-Conserving Hair Reflectance Model", in pbrt-v3's form.
///
/// A path reflects off the cuticle (p = 0), goes through (1), or leaves after p − 1 reflections
/// inside; all paths from the fourth on are one lobe without azimuthal structure. In the lobe's
/// frame x goes along the hair. Sampling follows each factor exactly, so a sample's weight is the
/// colour of the attenuation over its luminance. The model is not reciprocal.
#pragma once

#include <array>

#include "base/bsdf.h"

namespace lampyris {

class HairLobe final : public Lobe {
 public:
  struct Parameters {
    float h;      ///< where the ray meets the hair's width, in [−1, 1]
    float eta;    ///< index of refraction, ≥ 1
    Rgb sigmaA;   ///< absorption over the hair's radius
    float betaM;  ///< roughness along the hair, in (0, 1]
    float betaN;  ///< roughness around it, in (0, 1]
    float alpha;  ///< tilt of the cuticle's scales, in degrees
  };
  explicit HairLobe(const Parameters& p);

  Rgb f(const Vec3& wo, const Vec3& wi) const override;
  float pdf(const Vec3& wo, const Vec3& wi) const override;
  std::optional<LobeSample> sample(const Vec3& wo, float uc, const Vec2& u) const override;
  float albedo(const Vec3&) const override { return scale.luminance(); }

 private:
  static constexpr int kPaths = 4;  ///< three separate ones and all the others
  struct Angles;
  struct Incidence;
  Incidence incidence(const Vec3& wo) const;
  Angles tilted(const Angles& o, int path) const;
  /// Σ over paths of weight[p] × longitudinal × azimuthal density.
  template <class T>
  T sum(const Incidence& o, const Vec3& wi, const std::array<T, kPaths>& weights) const;
  float azimuth(int path, float gammaT) const;

  float h_, gammaO_, eta_, azimuthalScale_;
  Rgb sigmaA_;
  std::array<float, 3> variance_;           ///< of p = 0, 1 and all others
  std::array<float, 3> sinTilt_, cosTilt_;  ///< of α, 2α, 4α
};

/// Absorption of hair whose multiple scattering shows the colour `c` (Chiang et al. 2016, eq. 9).
Rgb hairAbsorptionOfColor(const Rgb& c, float betaN);
/// Absorption of concentrations of the two melanins (d'Eon et al. 2011, §6.1).
Rgb hairAbsorptionOfMelanin(float eumelanin, float pheomelanin);

}  // namespace lampyris
