// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/scene.h"
#include "integrators/render_loop.h"

namespace lampyris {

/// The medium that a ray is in which leaves a surface of `primitive` in direction `w`, having come
/// through `current`.
inline const Medium* mediumBeyond(const Primitive& primitive, const Medium* current, const Vec3& w,
                                  const Vec3& n) {
  return primitive.media.isTransition() ? primitive.media.towards(w, n) : current;
}

/// Share of the light that reaches the end of `ray` (a direction of any length), which starts
/// within `medium`: 0 behind a surface with a material; surfaces without one are passed. An
/// unbiased estimate.
Rgb transmittance(const Scene& scene, Ray ray, const Medium* medium, NumberSequence& numbers,
                  RayCounts& rays);

/// The medium around the point `p`, told by the surfaces between it and where `camera` starts.
const Medium* mediumAt(const Scene& scene, const Vec3& p, const Ray& camera, RayCounts& rays);

}  // namespace lampyris
