// SPDX-License-Identifier: Apache-2.0
/// An axis that depends on the place.
#pragma once

#include <cmath>

#include "core/vector.h"

namespace lampyris {

/// Points from everywhere towards, or away from, one point on the line through `place` along
/// `direction`: a lamp, or its image in glass or in a mirror (parallax; Ruppert et al. 2020,
/// "Robust Fitting of Parallax-Aware Mixtures for Path Guiding", §5, where the image lies ahead).
struct TurningAxis {
  Vec3 direction{0, 0, 1};  ///< at `place`; unit
  Vec3 place{0};
  /// 1 / distance of the point along `direction`; < 0 where light has crossed there before it
  /// arrives; 0: far away, the same direction everywhere.
  float turn = 0;

  /// Unit.
  Vec3 at(const Vec3& p) const {
    if (turn == 0) return direction;
    const Vec3 turned = direction - turn * (p - place);
    const float length2 = lengthSquared(turned);
    // At the very point there is no direction, and far away floats do not hold it.
    return length2 > 1e-6f && length2 < 1e12f ? turned / std::sqrt(length2) : direction;
  }
};

}  // namespace lampyris
