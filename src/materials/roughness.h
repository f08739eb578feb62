// SPDX-License-Identifier: Apache-2.0
/// Roughness parameters of microfacet materials.
#pragma once

#include "base/texture.h"
#include "materials/trowbridge_reitz.h"

namespace lampyris {

/// α of a roughness in [0, 1], pbrt-v3's fit (to Beckmann's and Blinn's exponents).
inline float roughnessToAlpha(float roughness) {
  const float x = std::log(std::max(1e-3f, roughness));
  return 1.62142f + x * (0.819955f + x * (0.1734f + x * (0.0171201f + x * 0.000640711f)));
}

/// Facets at a point.
struct Roughness {
  TrowbridgeReitz facets;
  bool smooth;  ///< both roughnesses were 0 as written
};

/// Two roughnesses that may be textures. The logarithm is taken once if they are constant.
class RoughnessInput {
 public:
  RoughnessInput(const TexturedFloat& isotropic, bool remap)
      : RoughnessInput(isotropic, isotropic, remap) {}
  RoughnessInput(const TexturedFloat& u, const TexturedFloat& v, bool remap)
      : u_(u), v_(v), remap_(remap), constant_(make(u.value, v.value)) {}

  Roughness operator()(const SurfaceInteraction& at) const {
    if (u_.isConstant() && v_.isConstant()) return constant_;
    const float u = u_(at);
    return make(u, !v_.isConstant() && v_.texture == u_.texture ? u : v_(at));
  }

 private:
  Roughness make(float u, float v) const {
    // std::max(0, x) also turns a NaN of a texture into 0.
    u = std::max(0.f, u), v = std::max(0.f, v);
    const bool smooth = u == 0 && v == 0;
    if (remap_) u = roughnessToAlpha(u), v = roughnessToAlpha(v);
    return {TrowbridgeReitz(u, v), smooth};
  }
  TexturedFloat u_, v_;
  bool remap_;
  Roughness constant_;
};

}  // namespace lampyris
