// SPDX-License-Identifier: Apache-2.0
/// Paths that are made from both ends, for the integrators that are built on them.
#pragma once

#include <optional>

#include "integrators/path_densities.h"
#include "integrators/subpath_tracer.h"

namespace lampyris {

/// What one path brings to the camera, and where on the film, in pixels. As for Film::addSplat().
struct Splat {
  Vec2 film{0};
  Rgb value;
};

/// Takes what paths from the lights bring to the camera. Thread-safe if several threads use it.
class SplatSink {
 public:
  virtual ~SplatSink() = default;
  virtual void splat(const Splat& splat) = 0;
};

/// A way to make a path: `fromLight` of its vertices are drawn from the light's side (1: by light
/// sampling), `fromCamera` from the camera's. In all bounces + 2.
struct PathStrategy {
  size_t fromLight = 0, fromCamera = 2;
};

/// Every estimate is weighed among all strategies that can make its path. Thread-safe.
class BidirectionalPaths {
 public:
  /// `distribution` may be null if there are no lights. `pixels`: where camera rays start, one for
  /// each path from the lights.
  BidirectionalPaths(const RenderContext& context, const LightDistribution* distribution,
                     const PixelBounds& pixels);

  /// The radiance along the camera's ray of all strategies for up to `maxDepth` bounces; those that
  /// lead the light's side to the camera itself go to `splats`. `stream` stands at
  /// kFirstPathDimension.
  Rgb all(int maxDepth, const CameraRay& camera, SampleStream& stream, RenderState& state,
          SplatSink& splats) const;
  /// How many strategies make paths of so many bounces.
  size_t strategyCount(int depth) const;
  /// The one of this number, < strategyCount(depth).
  PathStrategy strategy(int depth, size_t number) const;
  /// What this strategy alone brings: with two and more vertices from the camera, to where the ray
  /// comes from (`film`), as radiance; else as a splat. `numbers`: for what of media the stream's
  /// do not cover.
  Splat one(const PathStrategy& strategy, const Vec2& film, const CameraRay& camera,
            SampleStream& stream, const NumberSequence& numbers, RayCounts& rays) const;

 private:
  class Found;
  struct Paths;
  static Paths& threadPaths();
  void traceCamera(Paths& paths, const CameraRay& camera, size_t bounces, SampleStream& stream,
                   RayCounts& rays, EmissionSink* emission) const;
  void traceLight(Paths& paths, size_t bounces, SampleStream& stream, RayCounts& rays) const;
  Rgb joined(Paths& paths, size_t s, size_t t, SampleStream& stream, RayCounts& rays) const;
  Rgb sampleLight(Paths& paths, size_t t, SampleStream& stream, RayCounts& rays) const;
  Rgb connect(Paths& paths, size_t s, size_t t, RayCounts& rays) const;
  std::optional<Splat> connectCamera(Paths& paths, size_t s, SampleStream& stream,
                                     RayCounts& rays) const;
  Rgb passing(Paths& paths, const PathVertex& from, const LightSample& to, RayCounts& rays) const;

  const Scene& scene_;
  const Camera& camera_;
  const LightDistribution* const distribution_;
  const float splatFactor_;  ///< 1 / pixels of the film
  const EmitterTable emitters_;
  const SubpathTracer tracer_;
  const PathDensities densities_;
};

}  // namespace lampyris
