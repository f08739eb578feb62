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
  const Vec3 d = p - from;
  const float squared = lengthSquared(d);
  if (!(squared > 0)) return std::nullopt;
  LightSample s;
  s.distance = std::sqrt(squared);
  s.wi = d / s.distance;
  s.radiance = intensity(-s.wi) / squared;
  if (s.radiance.isBlack()) return std::nullopt;
  if (!s.radiance.isFinite()) {
    countRejection(Rejection::LightRadiance);
    return std::nullopt;
  }
  s.pdf = 1;
  s.p = p;
  return s;
}

}  // namespace lampyris
