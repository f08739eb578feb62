// SPDX-License-Identifier: Apache-2.0
/// Unidirectional path tracing, as the plugins "path" and "pathtree" configure it.
#pragma once

#include <memory>
#include <vector>

#include "base/integrator.h"

namespace lampyris {

struct PathSettings {
  int maxDepth = 5;       ///< bounces; emission seen directly is depth 0
  float rrThreshold = 1;  ///< below this throughput Russian roulette begins, from bounce 4 on
  std::vector<int> pixelBounds;
  SourceLocation location;

  void declare(Declaration& d);
};

/// `distribution` may be null if the scene has no lights.
std::unique_ptr<Integrator> makePathIntegrator(const PathSettings& settings,
                                               std::unique_ptr<LightDistribution> distribution);

}  // namespace lampyris
