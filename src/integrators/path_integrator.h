// SPDX-License-Identifier: Apache-2.0
/// Unidirectional path tracing, as the plugins "path" and "pathtree" configure it.
#pragma once

#include <memory>
#include <vector>

#include "integrators/adaptive_direct.h"

namespace lampyris {

struct PathSettings {
  int maxDepth = 5;       ///< bounces; emission seen directly is depth 0
  float rrThreshold = 1;  ///< below this throughput Russian roulette begins, from bounce 4 on
  std::vector<int> pixelBounds;
  SourceLocation location;
  bool adaptive = false;  ///< direct lighting by AdaptiveDirect
  AdaptiveSettings adaptiveSettings;
  int adaptiveVertices = 1;  ///< the first ones, where it takes more than one sample a technique

  void declare(Declaration& d);
};

/// `distribution` may be null if the scene has no lights; for adaptive direct lighting it is from
/// makeAdaptiveLights().
std::unique_ptr<Integrator> makePathIntegrator(const PathSettings& settings,
                                               std::unique_ptr<LightDistribution> distribution);

}  // namespace lampyris
