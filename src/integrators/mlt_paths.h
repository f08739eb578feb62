// SPDX-License-Identifier: Apache-2.0
/// Paths as functions of their primary samples, for Metropolis light transport.
#pragma once

#include "integrators/bidirectional.h"
#include "integrators/primary_samples.h"

namespace lampyris {

/// Thread-safe.
class MltPaths {
 public:
  /// `distribution` may be null if there are no lights. `differentialScale`: of camera rays.
  MltPaths(const RenderContext& context, const LightDistribution* distribution,
           float differentialScale);

  /// How many numbers a path of so many bounces may ask for.
  static size_t dimensions(int depth);
  /// What a path of `depth` bounces brings: of one of the strategies that make such paths, which is
  /// drawn as well. Its mean over uniform numbers is the film's mean of all such paths; black if it
  /// lies where no pixel is.
  Splat path(int depth, const PrimarySamples& numbers, RayCounts& rays) const;

 private:
  const Camera& camera_;
  const PixelBounds area_;  ///< where the film takes light from
  const float areaFactor_;  ///< pixels there, in relation to the film's
  const float differentialScale_;
  const BidirectionalPaths paths_;
};

}  // namespace lampyris
