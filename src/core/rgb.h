// SPDX-License-Identifier: Apache-2.0
/// Linear RGB with sRGB/Rec. 709 primaries: radiance, intensity, reflectance.
#pragma once

#include <algorithm>
#include <cmath>

namespace lampyris {

struct Rgb {
  float r = 0, g = 0, b = 0;

  constexpr Rgb() = default;
  constexpr explicit Rgb(float v) : r(v), g(v), b(v) {}
  constexpr Rgb(float red, float green, float blue) : r(red), g(green), b(blue) {}

  constexpr Rgb& operator+=(const Rgb& o) { return r += o.r, g += o.g, b += o.b, *this; }
  constexpr Rgb& operator-=(const Rgb& o) { return r -= o.r, g -= o.g, b -= o.b, *this; }
  constexpr Rgb& operator*=(const Rgb& o) { return r *= o.r, g *= o.g, b *= o.b, *this; }
  constexpr Rgb& operator*=(float s) { return r *= s, g *= s, b *= s, *this; }
  constexpr Rgb& operator/=(float s) { return *this *= 1 / s; }
  constexpr bool operator==(const Rgb&) const = default;

  constexpr bool isBlack() const { return r == 0 && g == 0 && b == 0; }
  bool isFinite() const { return std::isfinite(r) && std::isfinite(g) && std::isfinite(b); }
  constexpr float maxComponent() const { return std::max(r, std::max(g, b)); }
  /// Y of CIE XYZ: 0.2126 r + 0.7152 g + 0.0722 b (Rec. 709, the digits of pbrt-v3).
  constexpr float luminance() const { return 0.212671f * r + 0.715160f * g + 0.072169f * b; }
};

constexpr Rgb operator+(Rgb a, const Rgb& b) { return a += b; }
constexpr Rgb operator-(Rgb a, const Rgb& b) { return a -= b; }
constexpr Rgb operator*(Rgb a, const Rgb& b) { return a *= b; }
constexpr Rgb operator*(Rgb a, float s) { return a *= s; }
constexpr Rgb operator*(float s, Rgb a) { return a *= s; }
constexpr Rgb operator/(Rgb a, float s) { return a /= s; }
constexpr Rgb operator/(const Rgb& a, const Rgb& b) { return {a.r / b.r, a.g / b.g, a.b / b.b}; }

inline Rgb sqrt(const Rgb& c) { return {std::sqrt(c.r), std::sqrt(c.g), std::sqrt(c.b)}; }
inline Rgb exp(const Rgb& c) { return {std::exp(c.r), std::exp(c.g), std::exp(c.b)}; }
constexpr Rgb lerp(float t, const Rgb& a, const Rgb& b) { return (1 - t) * a + t * b; }
constexpr Rgb clampPositive(const Rgb& c) {
  return {std::max(c.r, 0.f), std::max(c.g, 0.f), std::max(c.b, 0.f)};
}

}  // namespace lampyris
