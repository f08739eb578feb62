// SPDX-License-Identifier: Apache-2.0
#include "integrators/light_connection.h"

#include <cmath>
#include <memory>

#include "core/rejections.h"

namespace lampyris {

namespace {

/// Where a shadow ray ends, in relation to the distance: the light's own surface must not shade it
/// (pbrt-v3's value, which decides what a blocker very near to a light does).
constexpr float kShadowEnd = 1 - 1e-4f;

}  // namespace

Ray shadowRay(const LightSampleContext& at, float time, const LightSample& light) {
  Ray ray;
  ray.time = time;
  ray.o = offsetRayOrigin(at.p, at.pError, at.n, light.wi);
  if (std::isinf(light.distance)) {
    ray.d = light.wi;
  } else {
    const bool surface = light.n != Vec3(0);
    const Vec3 end = surface ? offsetRayOrigin(light.p, light.pError, light.n, -light.wi) : light.p;
    ray.d = end - ray.o;
    ray.tMax = kShadowEnd;
  }
  return ray;
}

std::optional<LightSample> lightArriving(const Scene& scene, LightId light, const Vec3& from,
                                         const Vec2& u) {
  const LightTable::Entry entry = scene.lightTable[light];
  auto s = entry.light->sample(entry.element, from, u);
  if (s && !s->radiance.isBlack()) {
    if (s->pdf > 0 && std::isfinite(s->pdf)) return s;
    countRejection(Rejection::LightDensity);
  }
  s.reset();
  return s;
}

bool proposeConnection(const Scene& scene, const LightSampleContext& at, float time, LightId light,
                       const Vec2& u, LightConnection& out) {
  const auto s = lightArriving(scene, light, at.p, u);
  if (!s) return false;
  const Rgb scattered = at.scattered(s->wi);
  if (scattered.isBlack()) return false;
  std::construct_at(&out.shadow, shadowRay(at, time, *s));  // in place
  out.value = s->radiance * scattered;
  out.wi = s->wi;
  out.pdf = s->pdf;
  out.isDelta = scene.lightTable[light].light->isDelta();
  return true;
}

std::optional<LightConnection> connectToLight(const Scene& scene, const LightSampleContext& at,
                                              float time, LightId light, const Vec2& u,
                                              RayCounts& rays) {
  std::optional<LightConnection> out;
  const bool proposed = proposeConnection(scene, at, time, light, u, out.emplace());
  rays.shadow += proposed;
  if (!proposed || scene.geometry->occluded(out->shadow)) out.reset();
  return out;
}

}  // namespace lampyris
