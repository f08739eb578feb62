// SPDX-License-Identifier: Apache-2.0
/// What a ray meets, as integrators need it.
#pragma once

#include "base/material.h"
#include "base/scene.h"
#include "core/prefetch.h"
#include "core/rejections.h"

namespace lampyris {

/// A ray may pass this many surfaces without a material in a row: two that coincide must not hold
/// it forever.
inline constexpr int kMaxInterfaces = 1000;

/// Whether a ray that has passed so many, with the one that it stands at, may go on; if not, that
/// is counted.
inline bool mayPass(int interfaces) {
  if (interfaces <= kMaxInterfaces) return true;
  countRejection(Rejection::Interfaces);
  return false;
}

/// The surface at `hit`, in as much detail as its material asks for, with the footprint of
/// `differential` unless that is null or nothing there needs it.
inline SurfaceInteraction surfaceAt(const Geometry& geometry, const Ray& ray, const Hit& hit,
                                    const RayDifferential* differential) {
  const Material* const material = geometry.primitive(hit).material;
  if (!material) return geometry.surface(ray, hit, SurfaceDetail::Basic);
  if (!differential || !material->wantsDifferentials())
    return geometry.surface(ray, hit, material->detail());
  SurfaceInteraction at = geometry.surface(ray, hit, SurfaceDetail::Full);
  at.computeDifferentials(*differential);
  return at;
}

/// Fetches what surfaceAt() and the material will read first, for callers that have something to do
/// before.
inline void prefetchSurface(const Geometry& geometry, const Hit& hit) {
  const Primitive& primitive = geometry.primitive(hit);
  primitive.shape->prefetch(hit.element);
  prefetchLine(primitive.material);
}

/// Lets `ray` (unit direction), which has found `at`, go on behind it to where it was to end.
inline void startBehind(Ray& ray, const SurfaceInteraction& at) {
  const Vec3 o = offsetRayOrigin(at.p, at.pError, at.n, ray.d);
  ray.tMax -= dot(o - ray.o, ray.d);
  ray.o = o;
}

}  // namespace lampyris
