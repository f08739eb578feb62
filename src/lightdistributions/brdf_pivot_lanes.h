// SPDX-License-Identifier: Apache-2.0
/// Integrals of pivot transformed lobes over eight caps at once: brdf_pivot.h with the vectors of
/// the C++ Parallelism TS v2 (ISO/IEC TS 19570:2018, §9).
///
/// Deviation: where the horizon cuts a cap, what lies above it is a polynomial of how far it does
/// for small images, and for others the estimate of Oat and Sander 2007, "Ambient Aperture
/// Lighting": the smaller cap's area times a smooth step of the distance. Either is exact for caps
/// that touch the horizon from above or below.
#pragma once

#include <experimental/simd>

#include "lightdistributions/brdf_pivot.h"

namespace lampyris {

namespace stdx = std::experimental;
using Float8 = stdx::simd<float, stdx::simd_abi::deduce_t<float, 8>>;

/// Eight caps of less than a hemisphere.
struct CapLanes {
  Float8 x, y, z;  ///< axes, unit
  Float8 sine, cosine, versine;

  Float8 height(const Vec3& over) const { return over.x * x + over.y * y + over.z * z; }
};

class PivotLobeLanes {
 public:
  /// PivotLobe::mean() of each cap; raises `widest` as that does.
  static Float8 mean(const PivotLobe& lobe, const CapLanes& caps, Float8& widest);

 private:
  static Float8 clippedShare(const PivotLobe& lobe, const CapLanes& caps, const Float8& height,
                             const Float8& c, const Float8& length);
};

/// t² (3 − 2t) for t clamped to [0, 1].
inline Float8 smoothStep(const Float8& x) {
  const Float8 t = stdx::min(stdx::max(x, Float8(0)), Float8(1));
  return t * t * (3 - 2 * t);
}

/// Error below 7e-5 (Abramowitz and Stegun 1964, 4.4.45); x is clamped to [−1, 1].
inline Float8 arcCosine(const Float8& x) {
  const Float8 a = stdx::min(abs(x), Float8(1));
  Float8 r = sqrt(1 - a) * (1.5707288f + a * (-0.2121144f + a * (0.0742610f - 0.0187293f * a)));
  where(x < 0, r) = kPi - r;
  return r;
}

inline Float8 PivotLobeLanes::mean(const PivotLobe& lobe, const CapLanes& caps, Float8& widest) {
  const Float8 dx = caps.x - lobe.axis_.x, dy = caps.y - lobe.axis_.y, dz = caps.z - lobe.axis_.z;
  const Float8 toAxis = 0.5f * (dx * dx + dy * dy + dz * dz);
  const Float8 c =
      lobe.halfK_ * (toAxis - caps.versine) + lobe.halfWidth_ * (2 - toAxis - caps.versine);
  const Float8 length = sqrt(caps.sine * caps.sine + c * c);
  widest = stdx::max(widest, caps.sine / length);
  Float8 stretch = (1 + caps.cosine) / (length * (length + c));
  where(c < 0, stretch) = (length - c) / (length * caps.versine);
  Float8 mean = lobe.perSteradian_ * stretch;
  const Float8 height = caps.height(lobe.horizon_);
  if (const auto cut = height < caps.sine; any_of(cut))
    where(cut, mean) = mean * clippedShare(lobe, caps, height, c, length);
  return mean;
}

inline Float8 PivotLobeLanes::clippedShare(const PivotLobe& lobe, const CapLanes& caps,
                                           const Float8& height, const Float8& c,
                                           const Float8& length) {
  constexpr float kSmallImage = 0.05f;
  const Float8 h = stdx::min(stdx::max(height / caps.sine, Float8(-1)), Float8(1));
  Float8 share = 0.5f + h * (0.75f - 0.25f * h * h);
  const Float8 inverse = 1 / length, sine = caps.sine * inverse, cosine = c * inverse;
  const auto large = sine > kSmallImage || cosine < 0;
  if (none_of(large)) return share;
  const float other = lobe.horizonCosine_ / lobe.horizonLength_;
  const Float8 angle = arcCosine(cosine);
  const Float8 distance = arcCosine(cosine * other + sine / lobe.horizonLength_ * h);
  const Float8 overlap =
      (angle + lobe.horizonAngle_ - distance) / (2 * stdx::min(angle, Float8(lobe.horizonAngle_)));
  const Float8 smaller = stdx::min(Float8(1), (1 - other) / (1 - cosine));
  where(large, share) = smaller * smoothStep(overlap);
  where(large && h <= -1, share) = 0;
  return share;
}

}  // namespace lampyris
