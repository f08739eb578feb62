// SPDX-License-Identifier: Apache-2.0
/// Ideally diffuse lobes.
#pragma once

#include "base/bsdf.h"
#include "core/sampling.h"

namespace lampyris {

/// Reflects alike in all directions of a hemisphere. f() ignores on which side of the shading
/// normal the directions lie, as in pbrt-v3: the geometric normal decides, in Bsdf.
class LambertReflection final : public Lobe {
 public:
  explicit LambertReflection(const Rgb& reflectance) : Lobe(kReflection | kDiffuse) {
    scale = reflectance;
  }
  Rgb f(const Vec3&, const Vec3&) const override { return scale * kInvPi; }
  float pdf(const Vec3& wo, const Vec3& wi) const override {
    return sameHemisphere(wo, wi) ? cosineHemispherePdf(std::abs(wi.z)) : 0.f;
  }
  std::optional<LobeSample> sample(const Vec3& wo, float, const Vec2& u) const override {
    Vec3 wi = sampleCosineHemisphere(u);
    if (!(wi.z > 0)) return std::nullopt;
    const float density = cosineHemispherePdf(wi.z);
    if (wo.z < 0) wi.z = -wi.z;
    return LobeSample{wi, scale * kInvPi, density, flags, 1};
  }
  float albedo(const Vec3&) const override { return scale.luminance(); }
};

/// Transmits alike in all directions of the far hemisphere.
class LambertTransmission final : public Lobe {
 public:
  explicit LambertTransmission(const Rgb& transmittance) : Lobe(kTransmission | kDiffuse) {
    scale = transmittance;
  }
  Rgb f(const Vec3&, const Vec3&) const override { return scale * kInvPi; }
  float pdf(const Vec3& wo, const Vec3& wi) const override {
    return wo.z * wi.z < 0 ? cosineHemispherePdf(std::abs(wi.z)) : 0.f;
  }
  std::optional<LobeSample> sample(const Vec3& wo, float, const Vec2& u) const override {
    Vec3 wi = sampleCosineHemisphere(u);
    if (!(wi.z > 0)) return std::nullopt;
    const float density = cosineHemispherePdf(wi.z);
    if (wo.z > 0) wi.z = -wi.z;
    return LobeSample{wi, scale * kInvPi, density, flags, 1};
  }
  float albedo(const Vec3&) const override { return scale.luminance(); }
};

}  // namespace lampyris
