// SPDX-License-Identifier: Apache-2.0
#include "accelerators/light_bvh_cost.h"

#include <algorithm>
#include <cmath>

namespace lampyris {
namespace {

/// acos to 7e-5 (Abramowitz and Stegun 1964, 4.4.45): enough to compare splits.
float fastAcos(float x) {
  const float a = std::min(std::abs(x), 1.f);
  const float v =
      std::sqrt(1 - a) * (1.5707288f + a * (-0.2121144f + a * (0.0742610f - a * 0.0187293f)));
  return x < 0 ? kPi - v : v;
}

/// Ma 2018, eq. 3.3: the measure of the directions that a cone emits to.
float coneMeasure(float cosO, float cosE) {
  if (cosO < -0.999f) return 4 * kPi;
  const float thetaO = fastAcos(cosO), sinO = std::sqrt(std::max(0.f, 1 - cosO * cosO));
  float falloff = fastAcos(cosE);  // θw − θo
  float cosFalloff = cosE;
  if (thetaO + falloff > kPi) falloff = kPi - thetaO, cosFalloff = -cosO;
  // cos(2θw − θo) from cos and sin of θo and 2 (θw − θo).
  const float sinFalloff = std::sqrt(std::max(0.f, 1 - cosFalloff * cosFalloff));
  const float cos2 = 2 * cosFalloff * cosFalloff - 1, sin2 = 2 * sinFalloff * cosFalloff;
  const float cosSum = cosO * cos2 - sinO * sin2;
  return 2 * kPi * (1 - cosO) + kPi / 2 * (cosO - cosSum + 2 * falloff * sinO);
}

}  // namespace

bool usable(const LightBounds& b) {
  return b.intensity > 0 && std::isfinite(b.intensity) && !b.box.empty() && isFinite(b.box.min) &&
         isFinite(b.box.max);
}

BuildLight::BuildLight(const LightBounds& b, uint32_t index) {
  Vec3 axis = normalize(b.axis);
  if (b.twoSided) {  // a cone and its opposite count alike
    const float x = std::abs(axis.x), y = std::abs(axis.y), z = std::abs(axis.z);
    const float largest = x >= y && x >= z ? axis.x : (y >= z ? axis.y : axis.z);
    if (largest < 0) axis = -axis;
  }
  axis *= b.intensity * 0.5f * (1 + std::clamp(b.cosThetaO, -1.f, 1.f));
  lo = Float4{b.box.min.x, b.box.min.y, b.box.min.z, std::clamp(b.cosThetaE, -1.f, 1.f)};
  hi = Float4{b.box.max.x, b.box.max.y, b.box.max.z, std::bit_cast<float>(index | kIndexBit)};
  spread = Float4{axis.x, axis.y, axis.z, b.intensity};
}

float clusterCost(const Bucket& b, float invSize) {
  const Float4 e = (b.hi - b.lo) * splat(invSize), s = b.spread;
  const float area =
      2 * (e[0] * e[1] + e[1] * e[2] + e[2] * e[0]) + e[0] * e[0] + e[1] * e[1] + e[2] * e[2];
  if (!(s[3] > 0) || !(area > 0)) return 0;
  // Normals spread evenly over a cap of angle θo have a mean of length (1 + cos θo) / 2.
  const float mean = std::sqrt(s[0] * s[0] + s[1] * s[1] + s[2] * s[2]) / s[3];
  return s[3] * area * coneMeasure(std::min(2 * mean - 1, 1.f), b.lo[3]);
}

}  // namespace lampyris
