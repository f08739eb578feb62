// SPDX-License-Identifier: Apache-2.0
/// Fresnel's equations for unpolarised light at smooth boundaries (Born and Wolf, Principles of
/// Optics, §1.5.2, §14.2).
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "core/math.h"
#include "core/rgb.h"

namespace lampyris {

/// The index of refraction across a boundary, squared, and that less 1, to all digits: where it is
/// near 1, those decide what happens at grazing angles.
struct SquaredIndex {
  float square, excess;
  /// Of the far side in relation to the near one, that of the light; arguments as below.
  SquaredIndex(float cosI, float eta) : square(eta * eta), excess((eta - 1) * (eta + 1)) {
    if (cosI >= 0) return;
    square = 1 / square;
    excess *= -square;
  }
  /// (η cos θt)²; not positive beyond the critical angle.
  float refracted(float cosI) const { return excess + cosI * cosI; }
};

/// Share of light that a boundary of dielectrics reflects. `cosI` is the cosine between the normal
/// and the light's direction, negative on the far side of the normal. `eta` is the index of
/// refraction behind the boundary in relation to the one in front, as the normal looks; > 0.
inline float fresnelDielectric(float cosI, float eta) {
  if (eta == 1) return 0;
  const SquaredIndex index(cosI, eta);
  cosI = std::min(std::abs(cosI), 1.f);
  const float t2 = index.refracted(cosI);
  if (t2 <= 0) return 1;
  // Both amplitudes multiplied by their denominators: the differences are multiples of η² − 1 then.
  const float t = std::sqrt(t2);
  const float perpendicular = index.excess / sqr(cosI + t);
  const float parallel =
      index.excess * (cosI * cosI * (index.square + 1) - 1) / sqr(index.square * cosI + t);
  return 0.5f * (parallel * parallel + perpendicular * perpendicular);
}

/// Share of diffuse light that such a boundary reflects: Duntley 1942, "The Optical Properties of
/// Diffusing Materials"; from the denser side by reciprocity.
inline double fresnelDiffuse(double eta) {
  if (std::abs(eta - 1) < 1e-4) return 0;
  if (eta < 1) return 1 - (1 - fresnelDiffuse(1 / eta)) * eta * eta;
  const double n2 = eta * eta, n4 = n2 * n2;
  const double plus = n2 + 1, minus = n4 - 1;
  return 0.5 + (eta - 1) * (3 * eta + 1) / (6 * sqr(eta + 1)) +
         n2 * sqr(n2 - 1) / (plus * plus * plus) * std::log((eta - 1) / (eta + 1)) -
         2 * n2 * eta * (n2 + 2 * eta - 1) / (plus * minus) +
         8 * n4 * (n4 + 1) / (plus * minus * minus) * std::log(eta);
}

/// fresnelDielectric() for a conductor with the complex index eta + i k, from air, in one channel.
/// 0 ≤ cosI ≤ 1; eta, k in [0, 1e6].
inline float fresnelConductor(float cosI, float eta, float k) {
  const float cos2 = cosI * cosI, sin2 = std::max(0.f, 1 - cos2);
  // a and b are real and imaginary part of √((eta + i k)² − sin²).
  const float real = eta * eta - k * k - sin2;
  const float a2PlusB2 = std::sqrt(real * real + 4 * sqr(eta * k));
  const float a = std::sqrt(std::max(0.f, 0.5f * (a2PlusB2 + real)));
  const float cross = 2 * cosI * a;
  const float s = a2PlusB2 + cos2;
  const float perpendicular = s + cross > 0 ? (s - cross) / (s + cross) : 1.f;
  const float q = cos2 * a2PlusB2 + sin2 * sin2;
  const float ratio = q + cross * sin2 > 0 ? (q - cross * sin2) / (q + cross * sin2) : 1.f;
  return std::clamp(0.5f * perpendicular * (1 + ratio), 0.f, 1.f);
}

/// Fresnel terms of reflecting lobes. The cosine's sign says on which side of the surface.
struct DielectricFresnel {
  float eta;  ///< below the surface in relation to above
  float operator()(float cosI) const { return fresnelDielectric(cosI, eta); }
};

struct ConductorFresnel {
  Rgb eta, k;
  Rgb operator()(float cosI) const {
    const float c = std::min(std::abs(cosI), 1.f);
    // Four channels, so that compilers take them all in one vector.
    const std::array<float, 4> n{eta.r, eta.g, eta.b, eta.b}, absorption{k.r, k.g, k.b, k.b};
    std::array<float, 4> share;
    for (size_t i = 0; i < share.size(); ++i) share[i] = fresnelConductor(c, n[i], absorption[i]);
    return {share[0], share[1], share[2]};
  }
};

}  // namespace lampyris
