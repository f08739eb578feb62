// SPDX-License-Identifier: Apache-2.0
/// Fresnel's equations for unpolarised light at smooth boundaries (Born and Wolf, Principles of
/// Optics, §1.5.2, §14.2).
#pragma once

#include <algorithm>
#include <cmath>

#include "core/math.h"
#include "core/rgb.h"

namespace lampyris {

/// Share of light that a boundary of dielectrics reflects. `cosI` is the cosine between the normal
/// and the light's direction, negative on the far side of the normal. `eta` is the index of
/// refraction behind the boundary in relation to the one in front, as the normal looks; > 0.
inline float fresnelDielectric(float cosI, float eta) {
  if (eta == 1) return 0;
  if (cosI < 0) {
    cosI = -cosI;
    eta = 1 / eta;
  }
  cosI = std::min(cosI, 1.f);
  const float sin2T = (1 - cosI * cosI) / (eta * eta);
  if (sin2T >= 1) return 1;
  const float cosT = std::sqrt(1 - sin2T);
  const float parallel = (eta * cosI - cosT) / (eta * cosI + cosT);
  const float perpendicular = (cosI - eta * cosT) / (cosI + eta * cosT);
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
    return {fresnelConductor(c, eta.r, k.r), fresnelConductor(c, eta.g, k.g),
            fresnelConductor(c, eta.b, k.b)};
  }
};

}  // namespace lampyris
