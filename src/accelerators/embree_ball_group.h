// SPDX-License-Identifier: Apache-2.0
/// Up to eight balls that a ray is held against at once.
#pragma once

#include <embree3/rtcore.h>

#include <array>
#include <cstddef>
#include <cstdint>

#include "base/shape.h"

namespace lampyris::embree {

/// By parts, so that vector instructions serve them all.
class alignas(64) BallGroup {
 public:
  static constexpr size_t kSize = 8;

  BallGroup() { radius_.fill(-1); }
  /// `place` < kSize; the ball must be finite.
  void set(size_t place, const Ball& ball) {
    x_[place] = ball.center.x, y_[place] = ball.center.y, z_[place] = ball.center.z;
    radius_[place] = ball.radius;
  }
  /// A bit for each place that has a ball.
  uint32_t all() const;
  /// Of these bits, 0 only where all of the ray is outside of the ball, rounding of what is
  /// computed here included.
  uint32_t met(const RTCRay& ray) const;

 private:
  std::array<float, kSize> x_{}, y_{}, z_{};
  std::array<float, kSize> radius_;  ///< < 0: no ball
};
static_assert(sizeof(BallGroup) == 128);

}  // namespace lampyris::embree
