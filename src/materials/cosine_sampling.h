// SPDX-License-Identifier: Apache-2.0
/// Directions drawn in proportion to their cosine, for lobes that are nearly constant.
#pragma once

#include "base/bsdf.h"
#include "core/sampling.h"

namespace lampyris {

/// 1 if `w` is above the surface or in its plane, −1 below.
inline float sideOf(const Vec3& w) { return w.z < 0 ? -1.f : 1.f; }

/// Density of sampleCosine() with the same `side`.
inline float cosinePdf(float side, const Vec3& wi) {
  return cosineHemispherePdf(std::max(0.f, side * wi.z));
}

/// A direction of the hemisphere above (`side` = 1) or below (−1) with the lobe's value there.
template <class L>
std::optional<LobeSample> sampleCosine(const L& lobe, float side, const Vec3& wo, const Vec2& u) {
  std::optional<LobeSample> out;
  Vec3 wi = sampleCosineHemisphere(u);
  if (!(wi.z > 0)) return out;
  LobeSample& s = out.emplace();
  s.pdf = cosineHemispherePdf(wi.z);
  wi.z *= side;
  s.wi = wi;
  s.f = lobe.f(wo, wi);
  s.flags = lobe.flags;
  return out;
}

}  // namespace lampyris
