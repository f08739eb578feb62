// SPDX-License-Identifier: Apache-2.0
/// Light from a single point.
#pragma once

#include <cmath>
#include <optional>

#include "base/light.h"
#include "core/rejections.h"

namespace lampyris {

/// What `from` gets from a light at `p` that sends intensity(w) (W/sr) in direction `w` (unit, away
/// from the light). None if that is nothing, or `from` is where the light is.
template <class Intensity>
std::optional<LightSample> samplePoint(const Vec3& p, const Vec3& from,
                                       const Intensity& intensity) {
  std::optional<LightSample> out;
  const Vec3 d = p - from;
  const float squared = lengthSquared(d);
  if (!(squared > 0)) return out;
  const float distance = std::sqrt(squared);
  const Vec3 wi = d / distance;
  const Rgb radiance = intensity(-wi) / squared;
  if (radiance.isBlack()) return out;
  if (!radiance.isFinite()) {
    countRejection(Rejection::LightRadiance);
    return out;
  }
  LightSample& s = out.emplace();
  s.radiance = radiance;
  s.wi = wi;
  s.distance = distance;
  s.pdf = 1;
  s.p = p;
  return out;
}

}  // namespace lampyris
