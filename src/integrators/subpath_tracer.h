// SPDX-License-Identifier: Apache-2.0
/// Random walks from the camera and from the lights.
#pragma once

#include "base/integrator.h"
#include "integrators/emitter_table.h"
#include "integrators/path_vertex.h"
#include "integrators/render_loop.h"

namespace lampyris {

/// Dimensions of the numbers that vertex `i` of either subpath takes, from this on: one, a pair, a
/// pair, one, and a pair for the distance behind it. Both walks have their first vertices at low
/// dimensions.
inline constexpr uint32_t kDimensionsPerVertex = 8;
inline uint32_t cameraDimension(size_t i) {
  return kFirstPathDimension + static_cast<uint32_t>(2 * i) * kDimensionsPerVertex;
}
inline uint32_t lightDimension(size_t i) { return cameraDimension(i) + kDimensionsPerVertex; }
/// The direction is drawn by a pair and one from here on; what stands before is left to others.
inline constexpr uint32_t kDirectionOffset = 3, kDistanceOffset = 6;

/// Takes the emission that a walk from the camera finds.
class EmissionSink {
 public:
  virtual ~EmissionSink() = default;
  /// `light`: where it is, with its density; `radiance`: what it adds, not yet weighed.
  virtual void found(const PathVertex& light, const Rgb& radiance) = 0;
};

/// Walks end where nothing is scattered; there is no roulette, as in pbrt-v3. They go through media
/// with `numbers`, which may be null: then media are ignored.
class SubpathTracer {
 public:
  SubpathTracer(const Scene& scene, const EmitterTable& emitters)
      : scene_(scene), emitters_(emitters) {}

  /// The camera and up to `bounces` vertices that scatter. `emission` is told while `out` ends
  /// before the light; null: the last vertex is only connected to. `pdf`: with which the camera
  /// chooses the direction; 0 if it cannot tell.
  void fromCamera(const CameraRay& camera, double pdf, size_t bounces, SampleStream stream,
                  NumberSequence* numbers, Subpath& out, RayCounts& rays,
                  EmissionSink* emission) const;
  /// A light and up to `bounces` vertices that scatter; empty if no light is emitted. `camera`: a
  /// ray of it, at the light's time.
  void fromLight(const Ray& camera, size_t bounces, SampleStream stream, NumberSequence* numbers,
                 Subpath& out, RayCounts& rays) const;

 private:
  struct Walk;
  bool advance(Walk& walk) const;
  bool scatterInMedium(Walk& walk, const Vec3& p) const;
  bool scatter(Walk& walk) const;
  void foundOutside(const Walk& walk) const;
  void foundAtHit(const Walk& walk, const SurfaceInteraction& at, float distance) const;

  const Scene& scene_;
  const EmitterTable& emitters_;
};

}  // namespace lampyris
