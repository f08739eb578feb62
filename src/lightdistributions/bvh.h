// SPDX-License-Identifier: Apache-2.0
/// The light sampler "bvh", for others that build on it.
#pragma once

#include "lightdistributions/light_set.h"

namespace lampyris {

struct BvhParameters {
  std::string tree = "wide", factors = "mean";
  float splitThreshold = 1;
  int maxCut = 8;

  void declare(Declaration& d);
};

/// The distribution "bvh" over the context's lights; `binary` is makeLightTree() of the same.
/// Throws SceneError at the context's location where parameters don't go together.
std::unique_ptr<LightDistribution> makeBvhLights(const BvhParameters& parameters,
                                                 LightBVHAccel binary,
                                                 const LightDistributionContext& context);
/// The same with a wide tree that others may use too.
std::unique_ptr<LightDistribution> makeWideBvhLights(const BvhParameters& parameters,
                                                     std::shared_ptr<const WideLightBVH> tree,
                                                     const LightDistributionContext& context);

}  // namespace lampyris
