// SPDX-License-Identifier: Apache-2.0
/// Cosine lobes (ω·a)ⁿ around an axis a, whole or clipped by a plane: their normalisation, density
/// and sampling (Bashford-Rogers et al. 2012, "A Significance Cache for Accelerating Global
/// Illumination", §3.3.3).
///
/// The exponents are 1, 2 and then 2ᵏ and 3·2ᵏ up to 2¹⁴ ("levels"): a real exponent is rounded up,
/// as the paper does to integers, and a power is a few squarings.
#pragma once

#include <cstdint>

#include "base/medium.h"

namespace lampyris {

inline constexpr int kLobeLevels = 28;
inline constexpr float kMaxLobeExponent = 16384;

/// 1, 2, 3, 4, 6, 8, 12, 16 … 16384.
constexpr uint32_t lobeExponent(int level) {
  if (level == 0) return 1;
  return level % 2 ? 1u << (level + 1) / 2 : 3u << (level - 2) / 2;
}
/// A power is a product of one (level 0), two or three factors, squared as often as the next says.
constexpr int lobeFactors(int level) { return level == 0 ? 1 : level % 2 ? 2 : 3; }
constexpr int lobeSquarings(int level) { return level == 0 ? 0 : (level - 1) / 2; }
/// The level of the least exponent ≥ e; the last one for larger e, the first one for NaN.
int lobeLevel(float e);

/// V(n, θ): the integral of max(0, ω·a)ⁿ over the directions above a plane whose normal is at the
/// angle θ from a. Exact to double precision, in O(n) operations, for any −1 ≤ cos θ ≤ 1.
double clippedLobeIntegral(uint32_t n, double cosTilt);

/// 1 / V of a level's exponent to float precision, in constant time, for 0 ≤ cosTilt ≤ 1.
float inverseClippedLobe(int level, float cosTilt);
/// 1 / V of the whole lobe: (n + 1) / 2π.
inline float inverseWholeLobe(int level) {
  return static_cast<float>(lobeExponent(level) + 1) / (2 * kPi);
}

/// max(0, ω·a)ⁿ for unit vectors.
float lobePower(int level, const Vec3& axis, const Vec3& w);

/// A direction of the whole lobe, with density lobePower() × inverseWholeLobe().
Vec3 sampleLobe(int level, const Vec3& axis, const Vec2& u);
/// A direction of the lobe above the plane: dot(w, n) > 0; dot(axis, n) must be > 0. Drawn again
/// with `more` while below.
Vec3 sampleClippedLobe(int level, const Vec3& axis, const Vec3& n, const Vec2& u,
                       NumberSequence& more);

}  // namespace lampyris
