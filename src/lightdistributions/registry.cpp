// SPDX-License-Identifier: Apache-2.0
#include "lightdistributions/registry.h"

// One line a plugin: n stands for the entry function nPlugin().
#define LAMPYRIS_LIGHT_DISTRIBUTIONS(PLUGIN) \
  PLUGIN(brdfLightDistribution)              \
  PLUGIN(bvhLightDistribution)               \
  PLUGIN(powerLightDistribution)             \
  PLUGIN(spatialLightDistribution)           \
  PLUGIN(uniformLightDistribution)

LAMPYRIS_REGISTRY(lightDistributionRegistry, "lightsampler", LightDistributionRegistry,
                  LAMPYRIS_LIGHT_DISTRIBUTIONS)
