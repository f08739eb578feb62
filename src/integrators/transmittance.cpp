// SPDX-License-Identifier: Apache-2.0
#include "integrators/transmittance.h"

#include "integrators/ray_surface.h"

namespace lampyris {

namespace {

/// What is measured along a ray wants its direction so.
void makeUnit(Ray& ray) {
  const float size = length(ray.d);
  if (size > 0) ray.d /= size;
  ray.tMax *= size;
}

}  // namespace

Rgb transmittance(const Scene& scene, Ray ray, const Medium* medium, NumberSequence& numbers,
                  RayCounts& rays) {
  ++rays.shadow;
  const Geometry& geometry = *scene.geometry;
  if (!scene.hasInterfaces) {
    if (geometry.occluded(ray)) return Rgb();
    if (!medium) return Rgb(1);
  }
  makeUnit(ray);
  if (!scene.hasInterfaces) return medium->transmittance(ray, numbers, rays.tracking);
  Rgb share(1);
  for (int passed = 0; mayPass(passed); ++passed) {
    const auto hit = geometry.intersect(ray);
    if (hit && geometry.primitive(*hit).material) return Rgb();
    if (medium) {
      Ray segment = ray;
      if (hit) segment.tMax = hit->shape.t;
      share *= medium->transmittance(segment, numbers, rays.tracking);
    }
    if (!hit || share.isBlack()) return share;
    const SurfaceInteraction at = geometry.surface(ray, *hit, SurfaceDetail::Basic);
    medium = mediumBeyond(*at.primitive, medium, ray.d, at.n);
    startBehind(ray, at);
    if (!(ray.tMax > 0)) return share;
  }
  return Rgb();
}

const Medium* mediumAt(const Scene& scene, const Vec3& p, const Ray& camera, RayCounts& rays) {
  const Geometry& geometry = *scene.geometry;
  const Vec3 d = camera.o - p;
  Ray ray{p, normalize(d), length(d), camera.time};
  for (int passed = 0; ray.tMax > 0 && mayPass(passed); ++passed) {
    ++rays.closest;
    const auto hit = geometry.intersect(ray);
    if (!hit) break;
    const SurfaceInteraction at = geometry.surface(ray, *hit, SurfaceDetail::Basic);
    const MediumInterface& media = at.primitive->media;
    if (media.isTransition()) return media.towards(-ray.d, at.n);
    startBehind(ray, at);
  }
  return scene.cameraMedium;
}

}  // namespace lampyris
