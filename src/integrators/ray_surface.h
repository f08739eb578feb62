// SPDX-License-Identifier: Apache-2.0
/// What a ray meets, as integrators need it.
#pragma once

#include "base/material.h"
#include "base/scene.h"

namespace lampyris {

/// A ray may pass this many surfaces without a material in a row: two that coincide must not hold
/// it forever.
inline constexpr int kMaxInterfaces = 1000;

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

}  // namespace lampyris
