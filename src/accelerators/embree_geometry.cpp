// SPDX-License-Identifier: Apache-2.0
/// Rays by Embree 3 (Wald et al. 2014, "Embree: A Kernel Framework for Efficient CPU Ray Tracing"),
/// in its watertight mode: triangles by Embree itself from the shapes' buffers, other shapes by
/// callbacks, object instances as a second level.
#include "accelerators/embree_geometry.h"

#include <embree3/rtcore.h>

#include <deque>
#include <limits>
#include <utility>

#include "accelerators/embree_callbacks.h"
#include "accelerators/embree_device.h"
#include "accelerators/embree_motion.h"

namespace lampyris {

namespace {

using embree::Device;

struct SceneReleaser {
  void operator()(RTCScene s) const { rtcReleaseScene(s); }
};
struct GeometryReleaser {
  void operator()(RTCGeometry g) const { rtcReleaseGeometry(g); }
};
using SceneHandle = std::unique_ptr<std::remove_pointer_t<RTCScene>, SceneReleaser>;
using GeometryHandle = std::unique_ptr<std::remove_pointer_t<RTCGeometry>, GeometryReleaser>;

SceneHandle newScene(Device& device) {
  SceneHandle scene(rtcNewScene(device));
  device.check();
  rtcSetSceneBuildQuality(scene.get(), RTC_BUILD_QUALITY_HIGH);
  rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);
  return scene;
}

GeometryHandle newGeometry(Device& device, RTCGeometryType type) {
  GeometryHandle geometry(rtcNewGeometry(device, type));
  device.check();
  return geometry;
}

void setTriangles(RTCGeometry geometry, const TriangleBuffers& t) {
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, t.positions, 0,
                             sizeof(Vec3), t.vertexCount);
  rtcSetSharedGeometryBuffer(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, t.indices, 0,
                             3 * sizeof(uint32_t), t.triangleCount);
}

void attach(Device& device, RTCScene scene, RTCGeometry geometry, unsigned id) {
  rtcCommitGeometry(geometry);
  rtcAttachGeometryByID(scene, geometry, id);
  device.check();
}

/// The primitive must stay where it is.
GeometryHandle meshGeometry(Device& device, const Primitive& primitive,
                            const TriangleBuffers& triangles) {
  GeometryHandle geometry = newGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
  // Embree hands the pointer back as const data.
  rtcSetGeometryUserData(geometry.get(), const_cast<Primitive*>(&primitive));
  setTriangles(geometry.get(), triangles);
  // Filters cost on every candidate, so only where there is something to filter.
  if (primitive.alpha) rtcSetGeometryIntersectFilterFunction(geometry.get(), embree::filterNearest);
  if (primitive.alpha || primitive.shadowAlpha)
    rtcSetGeometryOccludedFilterFunction(geometry.get(), embree::filterOccluded);
  return geometry;
}

/// The shapes must stay where they are.
GeometryHandle userGeometry(Device& device, const embree::UserShapes& shapes) {
  GeometryHandle geometry = newGeometry(device, RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserData(geometry.get(), const_cast<embree::UserShapes*>(&shapes));
  rtcSetGeometryUserPrimitiveCount(geometry.get(), static_cast<unsigned>(shapes.size()));
  rtcSetGeometryBoundsFunction(geometry.get(), embree::bounds, nullptr);
  rtcSetGeometryIntersectFunction(geometry.get(), embree::intersect);
  rtcSetGeometryOccludedFunction(geometry.get(), embree::occluded);
  return geometry;
}

/// Meshes take the numbers of their primitives, all other shapes together `userId`.
SceneHandle buildScene(Device& device, const std::vector<Primitive>& primitives, size_t userId,
                       std::deque<embree::UserShapes>& userShapes) {
  SceneHandle scene = newScene(device);
  for (uint32_t i = 0; i < primitives.size(); ++i) {
    const TriangleBuffers triangles = primitives[i].shape->triangles();
    if (triangles.triangleCount > 0)
      attach(device, scene.get(), meshGeometry(device, primitives[i], triangles).get(), i);
  }
  const embree::UserShapes& others = userShapes.emplace_back(primitives);
  if (others.size() == 0) return scene;
  attach(device, scene.get(), userGeometry(device, others).get(), static_cast<unsigned>(userId));
  return scene;
}

void commit(Device& device, RTCScene scene) {
  embree::buildBegun.give();
  rtcCommitScene(scene);
  embree::buildDone.take();
  device.check();
}

/// Embree takes coordinates below 1.844e18 and may end the process on others.
constexpr float kEmbreeLimit = 1.8e18f;
/// Instances that are smaller than one part in this are left out: nobody sees them, and rays in
/// their space would be beyond Embree's limit.
constexpr float kMostShrinking = 1e9f;

/// The largest factor by which the map enlarges a component; infinite if it is singular.
float enlargement(const glm::mat4& m, bool singular) {
  if (singular) return kInfinity;
  float most = 0;
  for (int c = 0; c < 3; ++c) most = std::max(most, maxComponent(absComponents(Vec3(m[c]))));
  return 3 * most;
}

/// Elements that balls bound, in definitions of objects once.
size_t countBalls(const GeometryDescription& description) {
  size_t count = embree::countBalls(description.primitives);
  for (const auto& object : description.objects) count += embree::countBalls(object.primitives);
  return count;
}

class EmbreeGeometry final : public Geometry {
 public:
  explicit EmbreeGeometry(GeometryDescription description);

  std::optional<Hit> intersect(const Ray& ray) const override;
  bool occluded(const Ray& ray) const override;
  SurfaceInteraction surface(const Ray& ray, const Hit& hit, SurfaceDetail detail) const override;
  const Primitive& primitive(const Hit& hit) const override {
    if (hit.instance == Hit::kNoInstance) return description_.primitives[hit.primitive];
    return description_.objects[description_.instances[hit.instance].object]
        .primitives[hit.primitive];
  }
  Bounds3 bounds() const override { return bounds_; }
  RTCScene scene() const { return scene_.get(); }

 private:
  void attachInstances();
  GeometryHandle stillInstance(const ObjectInstance& instance, RTCScene object);
  GeometryHandle movingInstance(const ObjectInstance& instance, RTCScene object, unsigned id);

  const GeometryDescription description_;
  Device& device_;
  std::deque<embree::UserShapes> userShapes_;  ///< Embree points to them
  std::deque<embree::MovingInstance> moving_;  ///< and to these
  std::vector<SceneHandle> objects_;
  SceneHandle scene_;
  Bounds3 bounds_;
  float rayLimit_ =
      kEmbreeLimit;  ///< of the components of rays, such that instances stay in limits
};

EmbreeGeometry::EmbreeGeometry(GeometryDescription description)
    : description_(std::move(description)),
      device_(Device::forBalls(countBalls(description_))),
      scene_(buildScene(device_, description_.primitives,
                        description_.primitives.size() + description_.instances.size(),
                        userShapes_)) {
  attachInstances();
  commit(device_, scene_.get());
  RTCBounds b;
  rtcGetSceneBounds(scene_.get(), &b);
  if (b.lower_x <= b.upper_x && b.lower_y <= b.upper_y && b.lower_z <= b.upper_z)
    bounds_ = {{b.lower_x, b.lower_y, b.lower_z}, {b.upper_x, b.upper_y, b.upper_z}};
}

/// Instances take the geometry numbers after those of the primitives. Definitions without an
/// instance are not built; a singular map leaves nothing that a ray could meet.
void EmbreeGeometry::attachInstances() {
  objects_.resize(description_.objects.size());
  for (size_t i = 0; i < description_.instances.size(); ++i) {
    const ObjectInstance& instance = description_.instances[i];
    const Transform& toWorld = instance.instanceToWorld;
    const float inverse = enlargement(toWorld.inverseMatrix(), toWorld.isSingular());
    if (!(inverse <= kMostShrinking)) continue;
    rayLimit_ = std::min(rayLimit_, kEmbreeLimit / (2 * std::max(1.f, inverse)));
    const auto& primitives = description_.objects[instance.object].primitives;
    if (primitives.empty()) continue;
    SceneHandle& object = objects_[instance.object];
    if (!object) {
      object = buildScene(device_, primitives, primitives.size(), userShapes_);
      commit(device_, object.get());
    }
    const auto id = static_cast<unsigned>(description_.primitives.size() + i);
    const GeometryHandle geometry = instance.motion.empty()
                                        ? stillInstance(instance, object.get())
                                        : movingInstance(instance, object.get(), id);
    attach(device_, scene_.get(), geometry.get(), id);
  }
}

GeometryHandle EmbreeGeometry::stillInstance(const ObjectInstance& instance, RTCScene object) {
  GeometryHandle geometry = newGeometry(device_, RTC_GEOMETRY_TYPE_INSTANCE);
  rtcSetGeometryInstancedScene(geometry.get(), object);
  rtcSetGeometryTransform(geometry.get(), 0, RTC_FORMAT_FLOAT4X4_COLUMN_MAJOR,
                          &instance.instanceToWorld.matrix()[0][0]);
  return geometry;
}

GeometryHandle EmbreeGeometry::movingInstance(const ObjectInstance& instance, RTCScene object,
                                              unsigned id) {
  GeometryHandle geometry = newGeometry(device_, RTC_GEOMETRY_TYPE_USER);
  embree::setMovingInstance(geometry.get(), moving_.emplace_back(embree::MovingInstance{
                                                &instance, object, id, kEmbreeLimit}));
  return geometry;
}

/// Embree includes both ends of its interval; 0 < t < tMax excludes them. False for rays that can
/// meet nothing, and for those beyond `limit` or not finite, which Embree must not see.
bool toEmbree(const Ray& ray, float limit, RTCRay& out) {
  // A sum keeps NaN, a maximum may not.
  const Vec3 largest = absComponents(ray.o) + absComponents(ray.d);
  if (!(ray.tMax > 0 && largest.x <= limit && largest.y <= limit && largest.z <= limit))
    return false;
  // Four at once, as Embree reads them: a read of what lies in several writes waits for them.
  using Four = float __attribute__((vector_size(16), may_alias));
  constexpr float kNear = std::numeric_limits<float>::min();
  reinterpret_cast<Four&>(out.org_x) = Four{ray.o.x, ray.o.y, ray.o.z, kNear};
  reinterpret_cast<Four&>(out.dir_x) = Four{ray.d.x, ray.d.y, ray.d.z, ray.time};
  out.tfar = std::isinf(ray.tMax) ? ray.tMax : nextFloatDown(ray.tMax);
  out.mask = ~0u;
  out.id = out.flags = 0;
  return true;
}

std::optional<Hit> EmbreeGeometry::intersect(const Ray& ray) const {
  std::optional<Hit> out;
  RTCRayHit query;
  if (!toEmbree(ray, rayLimit_, query.ray)) return out;
  query.hit.geomID = query.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcIntersect1(scene_.get(), &context, &query);
  if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return out;
  Hit& hit = out.emplace();
  hit.shape = {query.ray.tfar, {query.hit.u, query.hit.v}};
  hit.primitive = query.hit.geomID;
  hit.element = query.hit.primID;
  if (query.hit.instID[0] != RTC_INVALID_GEOMETRY_ID)
    hit.instance = query.hit.instID[0] - static_cast<uint32_t>(description_.primitives.size());
  return out;
}

bool EmbreeGeometry::occluded(const Ray& ray) const {
  RTCRay query;
  if (!toEmbree(ray, rayLimit_, query)) return false;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  rtcOccluded1(scene_.get(), &context, &query);
  return query.tfar < 0;
}

/// Derivatives of A n / |A n| by those of n, A n / |A n| given, for A the map of normals.
Vec3 normalDerivative(const Transform& t, float scale, const Vec3& worldNormal, const Vec3& d) {
  const Vec3 v = t.normal(d) * scale;
  return v - dot(worldNormal, v) * worldNormal;
}

/// From the definition's space to the world.
void transformSurface(const Transform& t, SurfaceInteraction& at) {
  const Vec3 local = at.p;
  at.p = t.affinePoint(local);
  at.pError = t.pointError(local, at.pError);
  // Rays come back through the rounded inverse map; what that is off by counts as well.
  const Transform back = t.inverse();
  const Vec3 returned = back.pointError(at.p, Vec3(0));
  for (int c = 0; c < 3; ++c) at.pError += absComponents(Vec3(t.matrix()[c])) * returned[c];

  const Vec3 n = t.normal(at.n), ns = t.normal(at.shading.n);
  at.n = normalize(n);
  at.shading.n = faceForward(normalize(ns), at.n);
  at.dndu = normalDerivative(t, 1 / length(n), at.n, at.dndu);
  at.dndv = normalDerivative(t, 1 / length(n), at.n, at.dndv);
  const float sign = dot(ns, at.shading.n) < 0 ? -1.f : 1.f;
  at.shading.dndu = normalDerivative(t, sign / length(ns), at.shading.n, at.shading.dndu);
  at.shading.dndv = normalDerivative(t, sign / length(ns), at.shading.n, at.shading.dndv);
  at.dpdu = t.vector(at.dpdu);
  at.dpdv = t.vector(at.dpdv);
  at.shading.dpdu = t.vector(at.shading.dpdu);
  at.shading.dpdv = t.vector(at.shading.dpdv);
}

SurfaceInteraction EmbreeGeometry::surface(const Ray& ray, const Hit& hit,
                                           SurfaceDetail detail) const {
  const Primitive& p = primitive(hit);
  SurfaceInteraction at;
  if (hit.instance == Hit::kNoInstance) {
    p.shape->surface(hit.element, hit.shape, ray, detail, at);
  } else {
    const Transform toWorld = description_.instances[hit.instance].toWorld(ray.time);
    const Transform toObject = toWorld.inverse();
    const Ray local{toObject.affinePoint(ray.o), toObject.vector(ray.d), ray.tMax, ray.time};
    p.shape->surface(hit.element, hit.shape, local, detail, at);
    transformSurface(toWorld, at);
  }
  at.wo = -normalize(ray.d);
  at.time = ray.time;
  at.primitive = &p;
  at.element = hit.element;
  return at;
}

}  // namespace

std::unique_ptr<Geometry> makeEmbreeGeometry(GeometryDescription description) {
  return std::make_unique<EmbreeGeometry>(std::move(description));
}

RTCSceneTy* embreeScene(const Geometry& geometry) {
  return dynamic_cast<const EmbreeGeometry&>(geometry).scene();
}

}  // namespace lampyris
