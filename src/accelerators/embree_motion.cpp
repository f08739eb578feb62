// SPDX-License-Identifier: Apache-2.0
#include "accelerators/embree_motion.h"

#include "accelerators/embree_callbacks.h"

namespace lampyris::embree {

namespace {

const MovingInstance& movingOf(const void* user) {
  return *static_cast<const MovingInstance*>(user);
}

void motionBounds(const RTCBoundsFunctionArguments* args) {
  buildBegun.take();
  const MovingInstance& moving = movingOf(args->geometryUserPtr);
  RTCBounds inner;
  rtcGetSceneBounds(moving.object, &inner);
  Bounds3 b;
  b.min = {inner.lower_x, inner.lower_y, inner.lower_z};
  b.max = {inner.upper_x, inner.upper_y, inner.upper_z};
  const auto& motion = moving.instance->motion;
  for (size_t i = motion.size(); i-- > 0;) b = motion[i].bounds(b);
  RTCBounds& out = *args->bounds_o;
  out.lower_x = b.min.x, out.lower_y = b.min.y, out.lower_z = b.min.z;
  out.upper_x = b.max.x, out.upper_y = b.max.y, out.upper_z = b.max.z;
  buildDone.give();
}

/// Calls trace() while `ray` is in the object's space and the instance is on Embree's stack.
template <class Trace>
void inObjectSpace(const MovingInstance& moving, RTCRay& ray, RTCIntersectContext& context,
                   Trace trace) {
  const Transform toObject = moving.instance->toWorld(ray.time).inverse();
  const Vec3 o(ray.org_x, ray.org_y, ray.org_z), d(ray.dir_x, ray.dir_y, ray.dir_z);
  const Vec3 origin = toObject.affinePoint(o), direction = toObject.vector(d);
  // Singular maps leave no direction; what is too large or not finite Embree must not see.
  const Vec3 largest = absComponents(origin) + absComponents(direction);
  const float limit = moving.rayLimit;
  if (!(largest.x <= limit && largest.y <= limit && largest.z <= limit) || direction == Vec3(0))
    return;
  ray.org_x = origin.x, ray.org_y = origin.y, ray.org_z = origin.z;
  ray.dir_x = direction.x, ray.dir_y = direction.y, ray.dir_z = direction.z;
  const unsigned outer = context.instID[0];
  context.instID[0] = moving.geometryId;
  trace();
  context.instID[0] = outer;
  ray.org_x = o.x, ray.org_y = o.y, ray.org_z = o.z;
  ray.dir_x = d.x, ray.dir_y = d.y, ray.dir_z = d.z;
}

void intersectMoving(const RTCIntersectFunctionNArguments* args) {
  if (!args->valid[0]) return;
  const MovingInstance& moving = movingOf(args->geometryUserPtr);
  auto& query = *reinterpret_cast<RTCRayHit*>(args->rayhit);
  inObjectSpace(moving, query.ray, *args->context,
                [&] { rtcIntersect1(moving.object, args->context, &query); });
}

void occludedMoving(const RTCOccludedFunctionNArguments* args) {
  if (!args->valid[0]) return;
  const MovingInstance& moving = movingOf(args->geometryUserPtr);
  auto& ray = *reinterpret_cast<RTCRay*>(args->ray);
  inObjectSpace(moving, ray, *args->context,
                [&] { rtcOccluded1(moving.object, args->context, &ray); });
}

}  // namespace

void setMovingInstance(RTCGeometry geometry, const MovingInstance& moving) {
  // Embree hands the pointer back as const data.
  rtcSetGeometryUserData(geometry, const_cast<MovingInstance*>(&moving));
  rtcSetGeometryUserPrimitiveCount(geometry, 1);
  rtcSetGeometryBoundsFunction(geometry, motionBounds, nullptr);
  rtcSetGeometryIntersectFunction(geometry, intersectMoving);
  rtcSetGeometryOccludedFunction(geometry, occludedMoving);
}

}  // namespace lampyris::embree
