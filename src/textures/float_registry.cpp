// SPDX-License-Identifier: Apache-2.0
#include "textures/float_registry.h"

// One line a plugin: n stands for the entry function nPlugin().
#define LAMPYRIS_FLOAT_TEXTURES(PLUGIN) \
  PLUGIN(constantFloatTexture)          \
  PLUGIN(scaleFloatTexture)             \
  PLUGIN(mixFloatTexture)               \
  PLUGIN(bilerpFloatTexture)            \
  PLUGIN(imagemapFloatTexture)          \
  PLUGIN(checkerboardFloatTexture)      \
  PLUGIN(dotsFloatTexture)              \
  PLUGIN(fbmFloatTexture)               \
  PLUGIN(wrinkledFloatTexture)          \
  PLUGIN(windyFloatTexture)

LAMPYRIS_REGISTRY(floatTextureRegistry, "float texture", FloatTextureRegistry,
                  LAMPYRIS_FLOAT_TEXTURES)
