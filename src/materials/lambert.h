// SPDX-License-Identifier: Apache-2.0
/// Ideally diffuse lobes.
#pragma once

#include "base/bsdf.h"
#include "materials/cosine_sampling.h"

namespace lampyris {

/// Reflects alike in all directions of a hemisphere. f() ignores on which side of the shading
/// normal the directions lie, as in pbrt-v3: the geometric normal decides, in Bsdf.
class LambertReflection final : public Lobe {
 public:
  explicit LambertReflection(const Rgb& reflectance) : Lobe(kReflection | kDiffuse) {
    scale = reflectance;
  }
  Rgb f(const Vec3&, const Vec3&) const override { return scale * kInvPi; }
  float pdf(const Vec3& wo, const Vec3& wi) const override { return cosinePdf(sideOf(wo), wi); }
  std::optional<LobeSample> sample(const Vec3& wo, float, const Vec2& u) const override {
    return sampleCosine(*this, sideOf(wo), wo, u);
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
  float pdf(const Vec3& wo, const Vec3& wi) const override { return cosinePdf(-sideOf(wo), wi); }
  std::optional<LobeSample> sample(const Vec3& wo, float, const Vec2& u) const override {
    return sampleCosine(*this, -sideOf(wo), wo, u);
  }
  float albedo(const Vec3&) const override { return scale.luminance(); }
};

}  // namespace lampyris
