// SPDX-License-Identifier: Apache-2.0
/// Object instances that move, as Embree user geometries: a ray enters the object's space as it is
/// at the ray's time. (Embree's own motion interpolates another decomposition, with an upper
/// triangular matrix for the scale, which is pbrt-v3's for diagonal scales only.)
#pragma once

#include <embree3/rtcore.h>

#include "base/geometry.h"

namespace lampyris::embree {

/// What a geometry's user data points to. Its box spans all times.
struct MovingInstance {
  const ObjectInstance* instance = nullptr;
  RTCScene object = nullptr;
  unsigned geometryId = 0;
  float rayLimit = 0;  ///< of the components of rays in the object's space
};

/// Makes `geometry`, a user geometry, the instance; `moving` must stay where it is.
void setMovingInstance(RTCGeometry geometry, const MovingInstance& moving);

}  // namespace lampyris::embree
