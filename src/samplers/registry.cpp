// SPDX-License-Identifier: Apache-2.0
#include "samplers/registry.h"

// One line a plugin: n stands for the entry function nPlugin().
// clang-format off
#define LAMPYRIS_SAMPLERS(PLUGIN) \
  PLUGIN(blueNoiseSampler)        \
  PLUGIN(sobolSampler)            \
  PLUGIN(haltonSampler)           \
  PLUGIN(zeroTwoSampler)          \
  PLUGIN(maxMinDistSampler)       \
  PLUGIN(stratifiedSampler)       \
  PLUGIN(randomSampler)
// clang-format on

LAMPYRIS_REGISTRY(samplerRegistry, "sampler", SamplerRegistry, LAMPYRIS_SAMPLERS)
