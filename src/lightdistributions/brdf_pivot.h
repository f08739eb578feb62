// SPDX-License-Identifier: Apache-2.0
/// Lobes that can be integrated over a cap of directions in closed form: spherical pivot
/// transformed distributions.
///
/// Dupuy, Heitz and Belcour 2017, "A Spherical Cap Preserving Parameterization for Spherical
/// Distributions". The uniform density on the unit sphere, seen through the Möbius transform with
/// pivot p, |p| < 1, is one lobe; the transform takes caps to caps, so the lobe's integral over a
/// cap is the solid angle of another one.
///
/// Here the transform is written as what it also is, a Lorentz boost along p by the factor
/// k = (1 + |p|) / (1 − |p|): the cap {ω : ω·a ≥ cos θ} is the four-vector (a, cos θ), its image is
/// the boosted one, and both the product of two of them and sin θ = √(a² − cos²θ) stay what they
/// were. Differences of cosines are taken as differences of chords, which keeps all digits for
/// k → ∞ (mirrors).
///
/// Deviation: none. Cost: one square root a cap; four arc functions more where the horizon cuts
/// a cap that is not small.
#pragma once

#include <algorithm>
#include <cmath>

#include "core/math.h"
#include "core/vector.h"

namespace lampyris {

/// Directions within an angle θ < 90° of an axis.
struct DirectionCap {
  Vec3 axis{0, 0, 1};  ///< unit
  float sine = 0;      ///< sin θ in [0, 1)
  float versine = 0;   ///< 1 − cos θ, precise for small θ

  DirectionCap() = default;
  /// `sine2`: sin² θ.
  DirectionCap(const Vec3& unitAxis, float sine2)
      : axis(unitAxis),
        sine(std::sqrt(sine2)),
        versine(sine2 / (1 + std::sqrt(std::max(0.f, 1 - sine2)))) {}
  float cosine() const { return 1 - versine; }
  float solidAngle() const { return 2 * kPi * versine; }
};

/// Mean of max(0, ω·n) / π over a cap (of its whole solid angle), exact; `height` is axis·n.
float meanCosine(const DirectionCap& cap, float height);

/// A pivot transformed uniform density, of which one hemisphere counts.
class PivotLobe {
 public:
  PivotLobe() = default;
  /// `axis`: direction of the pivot, unit. `width`: 1/k in (0, 1]; about the tangent of half the
  /// lobe's angular radius, 1 for a uniform density. `horizon`: unit, the hemisphere's axis;
  /// the pivot lies in it. `integral`: what the lobe integrates to over the hemisphere.
  PivotLobe(const Vec3& axis, float width, const Vec3& horizon, float integral);

  /// Mean over a cap of its whole solid angle; what lies below the horizon counts as 0.
  float mean(const DirectionCap& cap) const {
    float widest = 0;
    return mean(cap, widest);
  }
  /// The same; raises `widest` to the sine of the angular radius of the cap's image: the larger,
  /// the more the density changes within the cap.
  float mean(const DirectionCap& cap, float& widest) const;
  /// Value in a direction, 1/sr.
  float density(const Vec3& w) const { return mean(DirectionCap(w, 0)); }
  /// Over the hemisphere.
  float integral() const { return integral_; }

 private:
  friend class PivotLobeLanes;
  /// The fourth component of a boosted cap: cos θ' |a'|. Both arguments are versines.
  float boosted(float toAxis, float capVersine) const {
    return halfK_ * (toAxis - capVersine) + halfWidth_ * (2 - toAxis - capVersine);
  }
  float clippedShare(const DirectionCap& cap, float height, float c, float length) const;

  Vec3 axis_{0, 0, 1}, horizon_{0, 0, 1};
  float halfK_ = 0.5f, halfWidth_ = 0.5f;
  float horizonCosine_ = 0, horizonLength_ = 1;  ///< fourth component of the horizon's image, |n'|
  float horizonAngle_ = 0.5f * kPi;              ///< angular radius of the horizon's image
  float integral_ = 0;
  float perSteradian_ = 0;  ///< amplitude / 4π
};

inline float PivotLobe::mean(const DirectionCap& cap, float& widest) const {
  const float height = dot(cap.axis, horizon_);
  if (height <= -cap.sine) return 0;
  const Vec3 chord = cap.axis - axis_;
  const float c = boosted(0.5f * dot(chord, chord), cap.versine);
  const float length = std::sqrt(sqr(cap.sine) + c * c);
  widest = std::max(widest, cap.sine / length);
  // Solid angle of the image over that of the cap: (1 − cos θ') / (1 − cos θ) without differences.
  const float stretch =
      c >= 0 ? (1 + cap.cosine()) / (length * (length + c)) : (length - c) / (length * cap.versine);
  const float whole = perSteradian_ * stretch;
  return height >= cap.sine ? whole : whole * clippedShare(cap, height, c, length);
}

}  // namespace lampyris
