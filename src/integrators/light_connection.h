// SPDX-License-Identifier: Apache-2.0
/// What all estimators of direct lighting share: light that arrives from a light's sample, and
/// light that a ray finds.
#pragma once

#include <optional>

#include "base/light_distribution.h"
#include "base/scene.h"
#include "integrators/render_loop.h"

namespace lampyris {

/// Light scattered at a point after it came from a sample of a light.
struct LightConnection {
  Rgb value;   ///< radiance × what is scattered of it, not divided by any density
  Ray shadow;  ///< what tells whether anything is in the way
  Vec3 wi{0};
  float pdf = 0;  ///< of the light's own sampling, by solid angle; 1 for delta lights
  bool isDelta = false;
};

/// From the point to a sample of a light: from t = 0 to 1 where that has a position. `d` is no unit
/// vector then.
Ray shadowRay(const LightSampleContext& at, float time, const LightSample& light);

/// The next of a sequence in the unit square with few gaps whatever its length (Roberts 2018):
/// points on the lights of one cut.
inline Vec2 nextInCut(Vec2 u) {
  u += Vec2(0.7548776662f, 0.5698402910f);
  return u - glm::floor(u);
}

/// Fetches the lights of a cut side by side; they are used one after the other.
inline void prefetchLights(const Scene& scene, const SampledLights& cut) {
  for (const SampledLight& l : cut) scene.lightTable.prefetch(l.light);
}

/// A sample of the light as seen from a point, with a density that can be divided by. None where
/// nothing arrives.
std::optional<LightSample> lightArriving(const Scene& scene, LightId light, const Vec3& from,
                                         const Vec2& u);
/// Sets `out` to what is scattered if nothing is in the way, which out.shadow will tell; false:
/// nothing is. at.scattered() must be known; `u` chooses the point of the light; `time` is that of
/// the shadow ray.
bool proposeConnection(const Scene& scene, const LightSampleContext& at, float time, LightId light,
                       const Vec2& u, LightConnection& out);
/// The same with the shadow ray traced: none either where nothing arrives.
std::optional<LightConnection> connectToLight(const Scene& scene, const LightSampleContext& at,
                                              float time, LightId light, const Vec2& u,
                                              RayCounts& rays);

/// Radiance that a ray from `from` finds at `hit` (an emitter), times weight(light id, density with
/// which the light itself would sample that point).
template <class Weight>
Rgb emissionAtHit(const Vec3& from, const SurfaceInteraction& hit, const Weight& weight) {
  const Primitive& primitive = *hit.primitive;
  const LightId id = primitive.lightId(hit.element);
  // As in pbrt-v3, an emitter within an object instance is seen but lights nothing.
  if (id == kNoLight) return Rgb();
  const Rgb emitted = primitive.light->emitted(hit, hit.wo);
  if (emitted.isBlack()) return emitted;
  return emitted * weight(id, primitive.light->pdfHit(hit.element, from, hit));
}

/// The same where it leaves the scene in direction `d`.
template <class Weight>
Rgb emissionOutside(const Scene& scene, const Vec3& d, const Weight& weight) {
  Rgb sum;
  for (size_t i = 0; i < scene.infiniteLights.size(); ++i) {
    const Light& light = *scene.infiniteLights[i];
    const LightId id = scene.infiniteLightIds[i];
    const Rgb radiance = light.escaped(d);
    if (radiance.isBlack()) continue;
    sum += radiance * (id == kNoLight ? 1.f : weight(id, light.pdfEscape(d)));
  }
  return sum;
}

}  // namespace lampyris
