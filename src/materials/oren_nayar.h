// SPDX-License-Identifier: Apache-2.0
/// Diffuse reflection of rough surfaces: Oren and Nayar 1994, "Generalization of Lambert's
/// Reflectance Model", the qualitative model (eq. 30).
#pragma once

#include "base/bsdf.h"
#include "materials/cosine_sampling.h"

namespace lampyris {

class OrenNayar final : public Lobe {
 public:
  /// `sigma`: standard deviation of the facets' slope angle, in degrees.
  OrenNayar(const Rgb& reflectance, float sigma) : Lobe(kReflection | kDiffuse) {
    scale = reflectance;
    const float s2 = sqr(radians(sigma));
    a_ = 1 - s2 / (2 * (s2 + 0.33f));
    b_ = 0.45f * s2 / (s2 + 0.09f);
  }
  Rgb f(const Vec3& wo, const Vec3& wi) const override {
    // cos(φi − φo) sin θi sin θo is the dot product in the tangent plane; sin α tan β is the
    // product of the sines over the larger cosine.
    const float inPlane = std::max(0.f, wo.x * wi.x + wo.y * wi.y);
    const float cosine = std::max(std::abs(wo.z), std::abs(wi.z));
    return scale * (kInvPi * (a_ + b_ * safeDivide(inPlane, cosine)));
  }
  float pdf(const Vec3& wo, const Vec3& wi) const override { return cosinePdf(sideOf(wo), wi); }
  std::optional<LobeSample> sample(const Vec3& wo, float, const Vec2& u) const override {
    return sampleCosine(*this, sideOf(wo), wo, u);
  }
  /// a_ is exact from above; from the side the second term adds what the first one lost.
  float albedo(const Vec3&) const override { return scale.luminance() * a_; }

 private:
  float a_, b_;
};

}  // namespace lampyris
