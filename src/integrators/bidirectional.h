// SPDX-License-Identifier: Apache-2.0
/// Bidirectional path tracing of one sample, for the integrators that are built on it.
#pragma once

#include "integrators/path_densities.h"
#include "integrators/subpath_tracer.h"

namespace lampyris {

/// Takes what paths from the lights bring to the camera, anywhere on the film. Thread-safe if the
/// estimator is used by several.
class SplatSink {
 public:
  virtual ~SplatSink() = default;
  /// As Film::addSplat().
  virtual void splat(const Vec2& film, const Rgb& value) = 0;
};

class BidirectionalEstimator final : public RadianceEstimator {
 public:
  /// `distribution` may be null if there are no lights. `pixels` are those that are rendered.
  BidirectionalEstimator(const RenderContext& context, int maxDepth,
                         const LightDistribution* distribution, const PixelBounds& pixels,
                         SplatSink& splats);

  /// Everything but the paths that the light's side leads to the camera itself: those go into the
  /// light image.
  Rgb radiance(const CameraRay& camera, SampleStream& stream, RenderState& state) const override;

 private:
  class Found;
  struct Paths;
  Rgb sampleLight(Paths& paths, size_t t, SampleStream& stream, RayCounts& rays) const;
  Rgb connect(Paths& paths, size_t s, size_t t, RayCounts& rays) const;
  void connectCamera(Paths& paths, size_t s, SampleStream& stream, RayCounts& rays) const;
  bool isVisible(const Ray& segment, RayCounts& rays) const;

  const Scene& scene_;
  const Camera& camera_;
  const int maxDepth_;
  const LightDistribution* const distribution_;
  const float splatFactor_;  ///< 1 / pixels of the film
  SplatSink& splats_;
  const EmitterTable emitters_;
  const SubpathTracer tracer_;
  const PathDensities densities_;
};

/// About the mean of a sample's radiance and splats, the same whenever it is asked for: for
/// Film::openLightImage(). From a few samples, spread over `pixels`.
double typicalSample(const RenderContext& context, int maxDepth,
                     const LightDistribution* distribution, const PixelBounds& pixels);

}  // namespace lampyris
