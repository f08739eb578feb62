// SPDX-License-Identifier: Apache-2.0
/// What Embree calls back while it traces a ray. User data of a geometry: its Primitive, or a
/// UserShapes. Rays come one at a time (rtcIntersect1, rtcOccluded1).
#pragma once

#include <embree3/rtcore.h>

#include "accelerators/embree_user_shapes.h"
#include "core/hand_over.h"

namespace lampyris::embree {

/// To and from the threads on which Embree asks for bounds while it builds.
inline const HandOver buildBegun, buildDone;

/// Of a UserShapes.
void bounds(const RTCBoundsFunctionArguments* args);
void intersect(const RTCIntersectFunctionNArguments* args);
void occluded(const RTCOccludedFunctionNArguments* args);
/// Reject hits where the alpha texture is 0, for nearest hits and for occlusion.
void filterNearest(const RTCFilterFunctionNArguments* args);
void filterOccluded(const RTCFilterFunctionNArguments* args);

}  // namespace lampyris::embree
