// SPDX-License-Identifier: Apache-2.0
#include "lights/registry.h"

// One line a plugin: n stands for the entry function nPlugin().
#define LAMPYRIS_LIGHTS(PLUGIN) \
  PLUGIN(distantLight)          \
  PLUGIN(goniometricLight)      \
  PLUGIN(infiniteLight)         \
  PLUGIN(pointLight)            \
  PLUGIN(projectionLight)       \
  PLUGIN(spotLight)

LAMPYRIS_REGISTRY(lightRegistry, "light", LightRegistry, LAMPYRIS_LIGHTS)
