// SPDX-License-Identifier: Apache-2.0
/// Direct lighting and what specular surfaces show of it, as the plugins "directlighting" and
/// "whitted" configure it.
#pragma once

#include <memory>
#include <vector>

#include "integrators/direct_lighting.h"

namespace lampyris {

struct DirectLightingSettings {
  int maxDepth = 5;
  std::vector<int> pixelBounds;
  SourceLocation location;

  void declare(Declaration& d);
};

/// `distribution` is used by LightStrategy::One.
std::unique_ptr<Integrator> makeDirectLightingIntegrator(
    const DirectLightingSettings& settings, LightStrategy strategy,
    std::unique_ptr<LightDistribution> distribution);

}  // namespace lampyris
