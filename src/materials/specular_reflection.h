// SPDX-License-Identifier: Apache-2.0
/// Reflection by an ideal mirror, alike at all angles.
#pragma once

#include "base/bsdf.h"

namespace lampyris {

class SpecularReflection final : public Lobe {
 public:
  explicit SpecularReflection(const Rgb& reflectance) : Lobe(kReflection | kSpecular) {
    scale = reflectance;
  }
  Rgb f(const Vec3&, const Vec3&) const override { return {}; }
  float pdf(const Vec3&, const Vec3&) const override { return 0; }
  std::optional<LobeSample> sample(const Vec3& wo, float, const Vec2&) const override {
    if (wo.z == 0) return std::nullopt;
    return LobeSample{{-wo.x, -wo.y, wo.z}, scale / std::abs(wo.z), 1, flags, 1};
  }
  float albedo(const Vec3&) const override { return scale.luminance(); }
};

}  // namespace lampyris
