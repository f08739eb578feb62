// SPDX-License-Identifier: Apache-2.0
/// What Embree calls back while it traces a ray. User data of a geometry: its Primitive. Rays come
/// one at a time (rtcIntersect1, rtcOccluded1).
#pragma once

#include <embree3/rtcore.h>

namespace lampyris::embree {

void bounds(const RTCBoundsFunctionArguments* args);
void intersect(const RTCIntersectFunctionNArguments* args);
void occluded(const RTCOccludedFunctionNArguments* args);
/// Reject hits where the alpha texture is 0, for nearest hits and for occlusion.
void filterNearest(const RTCFilterFunctionNArguments* args);
void filterOccluded(const RTCFilterFunctionNArguments* args);

}  // namespace lampyris::embree
