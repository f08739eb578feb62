// SPDX-License-Identifier: Apache-2.0
#include "samplers/registry.h"

// One line a plugin: n stands for the entry function nPlugin().
#define LAMPYRIS_SAMPLERS(PLUGIN)

LAMPYRIS_REGISTRY(samplerRegistry, "sampler", SamplerRegistry, LAMPYRIS_SAMPLERS)
