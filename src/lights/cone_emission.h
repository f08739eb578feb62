// SPDX-License-Identifier: Apache-2.0
/// Directions in which a light at a point emits: a cone, or all of them.
#pragma once

#include "base/light.h"
#include "core/frame.h"
#include "core/sampling.h"

namespace lampyris {

/// World space. Draws uniformly.
class ConeEmission {
 public:
  /// All directions.
  ConeEmission() = default;
  /// About `axis` (unit), to an angle whose 1 − cos is `oneMinusCos`, in (0, 2].
  ConeEmission(const Vec3& axis, float oneMinusCos) : axis_(axis), oneMinusCos_(oneMinusCos) {}

  Vec3 sample(const Vec2& u) const {
    return Frame::fromZ(axis_).toWorld(sampleUniformCone(u, oneMinusCos_));
  }
  float pdf(const Vec3& w) const {
    // By the chord: 1 − dot(axis, w) has no digits left in narrow cones. The margin is for
    // directions that rounding has put outside.
    const float edge = oneMinusCos_ + 1e-6f * std::sqrt(oneMinusCos_);
    return 0.5f * lengthSquared(w - axis_) <= edge ? uniformConePdf(oneMinusCos_) : 0.f;
  }
  /// A ray from the point `p` with the radiant intensity that `intensity(direction)` gives.
  template <class Intensity>
  std::optional<EmissionSample> emit(const Vec3& p, const Vec2& u,
                                     const Intensity& intensity) const {
    EmissionSample s;
    s.p = p;
    s.w = sample(u);
    s.radiance = intensity(s.w);
    if (s.radiance.isBlack()) return std::nullopt;
    s.pdfPosition = 1;
    s.pdfDirection = uniformConePdf(oneMinusCos_);
    return s;
  }

 private:
  Vec3 axis_{0, 0, 1};
  float oneMinusCos_ = 2;
};

}  // namespace lampyris
