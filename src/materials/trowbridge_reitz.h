// SPDX-License-Identifier: Apache-2.0
/// The Trowbridge–Reitz (GGX) distribution of microfacet normals with Smith's height-correlated
/// masking and shadowing.
///
/// Heitz 2014, "Understanding the Masking-Shadowing Function in Microfacet-Based BRDFs", eqs. 85,
/// 86, 99; visible normals after Dupuy and Benyoub 2023, "Sampling Visible GGX Normals with
/// Spherical Caps" (the distribution of Heitz 2018). With s(w) = √(z² + αx² x² + αy² y²) Smith's
/// 1 + 2Λ(w) is s(w)/|cos θ|, which turns every quotient that would be 0/0 at grazing angles into a
/// regular one.
#pragma once

#include <algorithm>
#include <cmath>

#include "core/frame.h"
#include "core/math.h"
#include "core/vector.h"

namespace lampyris {

class TrowbridgeReitz {
 public:
  /// Clamps as pbrt-v3 does below; above, where nearly all facets stand upright, floats end.
  TrowbridgeReitz(float alphaX, float alphaY)
      : ax_(std::clamp(alphaX, kMinAlpha, kMaxAlpha)),
        ay_(std::clamp(alphaY, kMinAlpha, kMaxAlpha)) {}

  /// Geometric mean of both directions'.
  float meanAlpha() const { return std::sqrt(ax_ * ay_); }
  /// Area of facets with normal m, by solid angle of m and surface area: ∫ D cos θ dω = 1.
  float density(const Vec3& m) const {
    const float a = ax_ * ay_;
    const float e = sqr(ay_ * m.x) + sqr(ax_ * m.y) + sqr(a * m.z);
    return a * a * a / (kPi * e * e);
  }
  /// G(wo, wi) / (4 |cos θo| |cos θi|); not both in the tangent plane.
  float visibilityOver4Cosines(const Vec3& wo, const Vec3& wi) const {
    return 0.5f / (stretched(wo) * std::abs(wi.z) + stretched(wi) * std::abs(wo.z));
  }
  /// G1(w) / |cos θ|: times D(m) |w·m| the density by solid angle of sampleVisible().
  float visibilityOverCosine(const Vec3& w) const { return 2 / (std::abs(w.z) + stretched(w)); }

  /// A facet's normal (z ≥ 0) drawn among those that face w, w.z > 0, as large as they look.
  Vec3 sampleVisible(const Vec3& w, const Vec2& u) const {
    const Vec3 v = normalize(Vec3(ax_ * w.x, ay_ * w.y, w.z));
    const float z = (1 - u.y) * (1 + v.z) - v.z;
    const Vec3 c = sphericalDirection(std::sqrt(std::max(0.f, 1 - z * z)), z, 2 * kPi * u.x);
    const Vec3 m = c + v;
    return upright(Vec3(ax_ * m.x, ay_ * m.y, std::max(m.z, 0.f)));
  }
  /// A facet's normal with density D(m) cos θm by solid angle.
  Vec3 sampleAll(const Vec2& u) const {
    const float slope = std::sqrt(u.x / (1 - u.x)), phi = 2 * kPi * u.y;
    return upright(Vec3(ax_ * slope * std::cos(phi), ay_ * slope * std::sin(phi), 1));
  }

 private:
  static constexpr float kMinAlpha = 1e-3f, kMaxAlpha = 1e3f;
  static Vec3 upright(const Vec3& m) {
    const Vec3 n = normalize(m);
    return n == Vec3(0) ? Vec3(0, 0, 1) : n;
  }
  float stretched(const Vec3& w) const {
    return std::sqrt(sqr(ax_ * w.x) + sqr(ay_ * w.y) + sqr(w.z));
  }
  float ax_, ay_;
};

/// The same facets with masking and shadowing independent of each other (Walter et al. 2007, eq.
/// 23): darker at grazing angles.
class SeparableTrowbridgeReitz : public TrowbridgeReitz {
 public:
  using TrowbridgeReitz::TrowbridgeReitz;
  float visibilityOver4Cosines(const Vec3& wo, const Vec3& wi) const {
    return 0.25f * visibilityOverCosine(wo) * visibilityOverCosine(wi);
  }
};

}  // namespace lampyris
