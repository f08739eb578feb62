// SPDX-License-Identifier: Apache-2.0
#include "textures/spectrum_registry.h"

// One line a plugin: n stands for the entry function nPlugin().
#define LAMPYRIS_SPECTRUM_TEXTURES(PLUGIN) \
  PLUGIN(constantSpectrumTexture)          \
  PLUGIN(scaleSpectrumTexture)             \
  PLUGIN(mixSpectrumTexture)               \
  PLUGIN(bilerpSpectrumTexture)            \
  PLUGIN(imagemapSpectrumTexture)          \
  PLUGIN(uvSpectrumTexture)                \
  PLUGIN(checkerboardSpectrumTexture)      \
  PLUGIN(dotsSpectrumTexture)              \
  PLUGIN(fbmSpectrumTexture)               \
  PLUGIN(wrinkledSpectrumTexture)          \
  PLUGIN(marbleSpectrumTexture)            \
  PLUGIN(windySpectrumTexture)

LAMPYRIS_REGISTRY(spectrumTextureRegistry, "spectrum texture", SpectrumTextureRegistry,
                  LAMPYRIS_SPECTRUM_TEXTURES)
