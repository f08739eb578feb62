// SPDX-License-Identifier: Apache-2.0
/// Orthonormal frames. In local coordinates z is the normal.
#pragma once

#include "core/math.h"
#include "core/vector.h"

namespace lampyris {

/// Two unit vectors that complete the unit vector `n` to a right-handed frame
/// (Duff et al. 2017, "Building an Orthonormal Basis, Revisited").
inline void completeBasis(const Vec3& n, Vec3& x, Vec3& y) {
  const float sign = std::copysign(1.f, n.z);
  const float a = -1 / (sign + n.z);
  const float b = n.x * n.y * a;
  x = Vec3(1 + sign * n.x * n.x * a, sign * b, -sign * n.x);
  y = Vec3(b, sign + n.y * n.y * a, -n.y);
}

/// A rotation between world space and a local space spanned by x, y, z (unit, orthogonal).
struct Frame {
  Vec3 x{1, 0, 0}, y{0, 1, 0}, z{0, 0, 1};

  static Frame fromZ(const Vec3& z) {
    Frame f;
    f.z = z;
    completeBasis(z, f.x, f.y);
    return f;
  }
  Vec3 toLocal(const Vec3& v) const { return {dot(v, x), dot(v, y), dot(v, z)}; }
  Vec3 toWorld(const Vec3& v) const { return v.x * x + v.y * y + v.z * z; }
};

// Trigonometry of a unit direction in local coordinates, θ measured from z.
inline float cosTheta(const Vec3& w) { return w.z; }
inline float absCosTheta(const Vec3& w) { return std::abs(w.z); }
inline float cos2Theta(const Vec3& w) { return w.z * w.z; }
inline float sin2Theta(const Vec3& w) { return std::max(0.f, 1 - w.z * w.z); }
inline float sinTheta(const Vec3& w) { return std::sqrt(sin2Theta(w)); }
inline float tan2Theta(const Vec3& w) { return sin2Theta(w) / cos2Theta(w); }
inline bool sameHemisphere(const Vec3& a, const Vec3& b) { return a.z * b.z > 0; }

/// The direction at polar angle θ and azimuth φ.
inline Vec3 sphericalDirection(float sinTheta, float cosTheta, float phi) {
  return {sinTheta * std::cos(phi), sinTheta * std::sin(phi), cosTheta};
}
inline float sphericalTheta(const Vec3& w) { return safeAcos(w.z); }
/// Azimuth in [0, 2π).
inline float sphericalPhi(const Vec3& w) {
  const float p = std::atan2(w.y, w.x);
  if (!(p < 0)) return p;
  const float turned = p + 2 * kPi;
  return turned < 2 * kPi ? turned : 0.f;  // a tiny negative angle rounds to a full turn
}

}  // namespace lampyris
