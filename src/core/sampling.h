// SPDX-License-Identifier: Apache-2.0
/// Warps of uniform variates in [0, 1) to directions and points, with their densities, and
/// tabulated distributions.
#pragma once

#include <span>
#include <vector>

#include "core/math.h"
#include "core/vector.h"

namespace lampyris {

/// (cos, sin) of the angle x π / 4 for |x| <= 1, to float precision: minimax polynomials, since the
/// library's functions spend most of their time on reducing angles of any size.
inline Vec2 octantPoint(float x) {
  const float t = x * x;
  const float c =
      1 + t * (-0.308425128f + t * (1.58543233e-2f + t * (-3.25936504e-4f + t * 3.52876155e-6f)));
  const float s =
      x * (0.785398185f + t * (-8.07454363e-2f + t * (2.49000103e-3f + t * -3.5950452e-5f)));
  return {c, s};
}
/// The point of the unit circle at an azimuth of `turns` full turns, in [0, 1].
inline Vec2 circlePoint(float turns) {
  const float quarters = 4 * turns, nearest = std::floor(quarters + 0.5f);
  const Vec2 p = octantPoint(2 * (quarters - nearest));
  const int k = static_cast<int>(nearest);
  const bool odd = k & 1;
  const float sign = static_cast<float>(1 - (k & 2));  // jumps would not be foreseen
  return {sign * (odd ? -p.y : p.x), sign * (odd ? p.x : p.y)};
}

/// With the density e^−x. In double precision: its logarithm is faster than log1p of a float.
inline float sampleExponential(float u) {
  return static_cast<float>(-std::log(1 - static_cast<double>(u)));
}

/// A point of the unit disk, area-preserving and continuous (Shirley and Chiu 1997).
inline Vec2 sampleConcentricDisk(const Vec2& u) {
  const Vec2 p = 2.f * u - 1.f;
  if (p.x == 0 && p.y == 0) return Vec2(0);
  const bool wide = std::abs(p.x) > std::abs(p.y);
  const float r = wide ? p.x : p.y;
  const Vec2 d = r * octantPoint((wide ? p.y : p.x) / r);
  return {wide ? d.x : d.y, wide ? d.y : d.x};
}
/// A direction of the upper hemisphere with pdf cos θ / π.
inline Vec3 sampleCosineHemisphere(const Vec2& u) {
  const Vec2 d = sampleConcentricDisk(u);
  return {d.x, d.y, std::sqrt(std::max(0.f, 1 - d.x * d.x - d.y * d.y))};
}
inline float cosineHemispherePdf(float cosTheta) { return cosTheta * kInvPi; }
/// A direction with pdf 1 / 4π.
Vec3 sampleUniformSphere(const Vec2& u);
/// A direction within the cone about +z whose half-angle has 1 − cos = `oneMinusCosMax`
/// (precise for tiny cones), with pdf uniformConePdf(oneMinusCosMax).
Vec3 sampleUniformCone(const Vec2& u, float oneMinusCosMax);
inline float uniformConePdf(float oneMinusCosMax) { return 1 / (2 * kPi * oneMinusCosMax); }
/// Barycentric coordinates (b0, b1) of a uniform point of a triangle; b2 = 1 − b0 − b1.
/// Keeps strata compact (Heitz 2019, "A Low-Distortion Map Between Triangle and Square").
Vec2 sampleUniformTriangle(const Vec2& u);

/// The balance heuristic's weight of the first technique; 0 where both densities are 0.
inline float balanceHeuristic(float pdf, float otherPdf) {
  if (std::isinf(pdf)) return 1;
  return pdf > 0 ? 1 / (1 + otherPdf / pdf) : 0.f;  // the sum of two large densities may overflow
}
/// The power heuristic (β = 2).
inline float powerHeuristic(float pdf, float otherPdf) {
  if (std::isinf(pdf)) return 1;
  const float r = otherPdf / pdf;
  return pdf > 0 ? 1 / (1 + r * r) : 0;
}

/// A piecewise-constant density over [0, 1) with equal cells. Values < 0 or not finite count as 0;
/// if all are 0 the density is uniform.
class Distribution1D {
 public:
  Distribution1D() = default;
  explicit Distribution1D(std::span<const float> values);

  struct Sample {
    float x;      ///< in [0, 1)
    float pdf;    ///< density at x
    size_t cell;  ///< index of x's cell
  };
  size_t size() const { return cdf_.empty() ? 0 : cdf_.size() - 1; }
  /// Mean of the values.
  double integral() const { return integral_; }
  /// sample().pdf == pdf(sample().x), exactly.
  Sample sample(float u) const;
  float pdf(float x) const { return density(cellOf(x)); }
  /// Probability of a cell.
  float pmf(size_t cell) const { return cdf_[cell + 1] - cdf_[cell]; }
  float density(size_t cell) const { return pmf(cell) * static_cast<float>(size()); }

 private:
  size_t cellOf(float x) const {
    return std::min(static_cast<size_t>(std::max(x, 0.f) * static_cast<float>(size())), size() - 1);
  }
  std::vector<float> cdf_;
  double integral_ = 0;
};

/// A piecewise-constant density over [0, 1)², row by row (`values[y * width + x]`).
class Distribution2D {
 public:
  Distribution2D() = default;
  Distribution2D(std::span<const float> values, int width, int height);

  struct Sample {
    Vec2 p;
    float pdf;
  };
  Sample sample(const Vec2& u) const;
  float pdf(const Vec2& p) const;
  double integral() const { return marginal_.integral(); }

 private:
  std::vector<Distribution1D> rows_;
  Distribution1D marginal_;
};

}  // namespace lampyris
