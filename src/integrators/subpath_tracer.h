// SPDX-License-Identifier: Apache-2.0
/// Random walks from the camera and from the lights.
#pragma once

#include "base/integrator.h"
#include "integrators/emitter_table.h"
#include "integrators/path_vertex.h"
#include "integrators/render_loop.h"

namespace lampyris {

/// Dimensions of the numbers that vertex `i` of either subpath takes, from this on: one, a pair, a
/// pair, one. Both walks have their first vertices at low dimensions.
inline constexpr uint32_t kDimensionsPerVertex = 8;
inline uint32_t cameraDimension(size_t i) {
  return kFirstPathDimension + static_cast<uint32_t>(2 * i) * kDimensionsPerVertex;
}
inline uint32_t lightDimension(size_t i) { return cameraDimension(i) + kDimensionsPerVertex; }
/// The direction is drawn by a pair and one from here on; what stands before is left to others.
inline constexpr uint32_t kDirectionOffset = 3;

/// Takes the emission that a walk from the camera finds.
class EmissionSink {
 public:
  virtual ~EmissionSink() = default;
  /// `light`: where it is, with its density; `radiance`: what it adds, not yet weighed.
  virtual void found(const PathVertex& light, const Rgb& radiance) = 0;
};

/// Walks end where nothing is scattered; there is no roulette, as in pbrt-v3.
class SubpathTracer {
 public:
  SubpathTracer(const Scene& scene, const EmitterTable& emitters)
      : scene_(scene), emitters_(emitters) {}

  /// The camera and up to `surfaces` surfaces. `emission` is told while `out` ends before the
  /// light; null: the last surface is only connected to. `pdf`: with which the camera chooses the
  /// direction; 0 if it cannot tell.
  void fromCamera(const CameraRay& camera, double pdf, size_t surfaces, SampleStream stream,
                  Subpath& out, RayCounts& rays, EmissionSink* emission) const;
  /// A light and up to `surfaces` surfaces; empty if no light is emitted.
  void fromLight(float time, size_t surfaces, SampleStream stream, Subpath& out,
                 RayCounts& rays) const;

 private:
  struct Walk;
  bool advance(Walk& walk) const;
  bool scatter(Walk& walk) const;
  void foundOutside(const Walk& walk) const;
  void foundAtHit(const Walk& walk, const SurfaceInteraction& at) const;

  const Scene& scene_;
  const EmitterTable& emitters_;
};

}  // namespace lampyris
