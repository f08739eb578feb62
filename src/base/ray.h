// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/math.h"
#include "core/vector.h"

namespace lampyris {

/// A half-line o + t d, 0 < t < tMax. `d` need not be unit.
struct Ray {
  Vec3 o{0}, d{0, 0, 1};
  float tMax = kInfinity;
  float time = 0;

  Vec3 at(float t) const { return o + t * d; }
};

/// The rays one pixel to the right (x) and one pixel down (y) of a camera ray.
struct RayDifferential {
  Vec3 xOrigin{0}, xDirection{0}, yOrigin{0}, yDirection{0};
};

}  // namespace lampyris
