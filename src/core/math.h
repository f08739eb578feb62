// SPDX-License-Identifier: Apache-2.0
/// Scalars: constants, domain-safe functions and floating-point error bounds.
#pragma once

#include <algorithm>
#include <bit>
#include <cassert>
#include <cmath>
#include <cstdint>
#include <limits>

namespace lampyris {

inline constexpr float kPi = 3.14159265358979323846f;
inline constexpr float kInvPi = 1 / kPi;
inline constexpr float kInfinity = std::numeric_limits<float>::infinity();
/// The largest float below 1: what a uniform variate in [0, 1) may be at most.
inline constexpr float kOneMinusEpsilon = 0x1.fffffep-1f;
/// Half the spacing of floats at 1: the relative error of one rounded operation.
inline constexpr float kMachineEpsilon = std::numeric_limits<float>::epsilon() * 0.5f;

/// Bound of the relative error after `n` rounded operations (Higham 2002, §3.1).
constexpr float roundingBound(int n) {
  const float ne = static_cast<float>(n) * kMachineEpsilon;
  return ne / (1 - ne);
}

constexpr float sqr(float x) { return x * x; }
constexpr double sqr(double x) { return x * x; }
constexpr float lerp(float t, float a, float b) { return (1 - t) * a + t * b; }
constexpr float radians(float degrees) { return degrees * (kPi / 180); }

/// √x for an x that is ≥ 0 but for rounding: below zero (to −1e-3 in relation to 1) counts as 0.
inline float safeSqrt(float x) {
  assert(!(x < -1e-3f));
  return std::sqrt(std::max(x, 0.f));
}
inline double safeSqrt(double x) {
  assert(!(x < -1e-3));
  return std::sqrt(std::max(x, 0.));
}
/// acos(x) for an x in [−1, 1] but for rounding (1e-3).
inline float safeAcos(float x) {
  assert(!(std::abs(x) > 1 + 1e-3f));
  return std::acos(std::clamp(x, -1.f, 1.f));
}
/// asin(x) for an x in [−1, 1] but for rounding (1e-3).
inline float safeAsin(float x) {
  assert(!(std::abs(x) > 1 + 1e-3f));
  return std::asin(std::clamp(x, -1.f, 1.f));
}
/// a / b, or 0 where b is 0 or the quotient is not finite.
inline float safeDivide(float a, float b) {
  const float q = a / b;
  return std::isfinite(q) ? q : 0.f;
}

/// The floats next to `x` (`x` itself at the infinity of that side, and if it is NaN). On the bits,
/// because every ray asks for it: std::nextafter is a call.
constexpr float nextFloatUp(float x) {
  if (!(x < kInfinity)) return x;
  if (x == 0) return std::numeric_limits<float>::denorm_min();
  const auto bits = std::bit_cast<uint32_t>(x);
  return std::bit_cast<float>(x > 0 ? bits + 1 : bits - 1);
}
constexpr float nextFloatDown(float x) { return -nextFloatUp(-x); }

}  // namespace lampyris
