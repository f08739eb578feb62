// SPDX-License-Identifier: Apache-2.0
#include "accelerators/embree_callbacks.h"

namespace lampyris::embree {

namespace {

enum class Query : uint8_t { Nearest, Occlusion };

const UserShapes& shapesOf(const void* user) { return *static_cast<const UserShapes*>(user); }

Ray toRay(const RTCRay& r, float tMax) {
  return {{r.org_x, r.org_y, r.org_z}, {r.dir_x, r.dir_y, r.dir_z}, tMax, r.time};
}

void evaluateSurface(const Primitive& primitive, uint32_t element, const ShapeHit& hit,
                     const Ray& ray, SurfaceInteraction& at) {
  primitive.shape->surface(element, hit, ray, SurfaceDetail::Basic, at);
  at.primitive = &primitive;
  at.element = element;
}

bool isHole(const FloatTexture* alpha, const SurfaceInteraction& at) {
  return alpha && alpha->evaluate(at) == 0;
}

/// Whether the ray passes this point.
bool passes(const Primitive& primitive, const SurfaceInteraction& at, Query query) {
  return isHole(primitive.alpha, at) ||
         (query == Query::Occlusion && isHole(primitive.shadowAlpha, at));
}

/// The nearest hit of a shape's element that alpha does not let pass.
std::optional<ShapeHit> firstHit(const Primitive& primitive, uint32_t element, const RTCRay& r,
                                 Query query) {
  // Embree allows t = tfar, Shape does not.
  Ray ray = toRay(r, nextFloatUp(r.tfar));
  auto hit = primitive.shape->intersect(element, ray);
  if (!primitive.alpha && (query == Query::Nearest || !primitive.shadowAlpha)) return hit;
  // A curved shape may be met again behind a hole; few times, so a bound is no loss.
  float passed = 0;
  for (int i = 0; hit && i < 64; ++i) {
    SurfaceInteraction at;
    evaluateSurface(primitive, element, *hit, ray, at);
    if (!passes(primitive, at, query)) return ShapeHit{passed + hit->t, hit->uv};
    passed += hit->t;
    ray.o = offsetRayOrigin(at.p, at.pError, at.n, ray.d);
    ray.tMax -= hit->t;
    hit = primitive.shape->intersect(element, ray);
  }
  return std::nullopt;
}

void filter(const RTCFilterFunctionNArguments* args, Query query) {
  if (!args->valid[0]) return;
  // With one ray the layouts of RTCRayN and RTCHitN are those of RTCRay and RTCHit.
  const auto& ray = *reinterpret_cast<const RTCRay*>(args->ray);
  const auto& hit = *reinterpret_cast<const RTCHit*>(args->hit);
  const auto& primitive = *static_cast<const Primitive*>(args->geometryUserPtr);
  SurfaceInteraction at;
  evaluateSurface(primitive, hit.primID, {ray.tfar, {hit.u, hit.v}}, toRay(ray, ray.tfar), at);
  if (passes(primitive, at, query)) args->valid[0] = 0;
}

}  // namespace

void bounds(const RTCBoundsFunctionArguments* args) {
  const UserShapes& shapes = shapesOf(args->geometryUserPtr);
  buildBegun.take();
  Bounds3 b;
  shapes.forEach(args->primID, [&](const UserShapes::Element& e) {
    b.extend(shapes.primitive(e).shape->bounds(e.element));
  });
  // Embree's box test is in single precision, the shapes' intersections are not.
  const Vec3 pad = 4 * kMachineEpsilon * glm::max(absComponents(b.min), absComponents(b.max));
  RTCBounds& out = *args->bounds_o;
  out.lower_x = b.min.x - pad.x, out.upper_x = b.max.x + pad.x;
  out.lower_y = b.min.y - pad.y, out.upper_y = b.max.y + pad.y;
  out.lower_z = b.min.z - pad.z, out.upper_z = b.max.z + pad.z;
  buildDone.give();
}

void intersect(const RTCIntersectFunctionNArguments* args) {
  if (!args->valid[0]) return;
  auto& query = *reinterpret_cast<RTCRayHit*>(args->rayhit);
  const UserShapes& shapes = shapesOf(args->geometryUserPtr);
  shapes.forEachMet(args->primID, query.ray, [&](const UserShapes::Element& e) {
    const auto hit = firstHit(shapes.primitive(e), e.element, query.ray, Query::Nearest);
    if (!hit) return;
    query.ray.tfar = hit->t;
    query.hit.u = hit->uv.x;
    query.hit.v = hit->uv.y;
    query.hit.primID = e.element;
    query.hit.geomID = e.primitive;
    query.hit.instID[0] = args->context->instID[0];
  });
}

void occluded(const RTCOccludedFunctionNArguments* args) {
  if (!args->valid[0]) return;
  auto& ray = *reinterpret_cast<RTCRay*>(args->ray);
  const UserShapes& shapes = shapesOf(args->geometryUserPtr);
  shapes.forEachMet(args->primID, ray, [&](const UserShapes::Element& e) {
    if (ray.tfar < 0) return;
    if (firstHit(shapes.primitive(e), e.element, ray, Query::Occlusion)) ray.tfar = -kInfinity;
  });
}

void filterNearest(const RTCFilterFunctionNArguments* args) { filter(args, Query::Nearest); }
void filterOccluded(const RTCFilterFunctionNArguments* args) { filter(args, Query::Occlusion); }

}  // namespace lampyris::embree
