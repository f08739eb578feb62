// SPDX-License-Identifier: Apache-2.0
#include "materials/registry.h"

// One line a plugin: n stands for the entry function nPlugin().
#define LAMPYRIS_MATERIALS(PLUGIN) \
  PLUGIN(matte)                    \
  PLUGIN(plastic)                  \
  PLUGIN(metal)                    \
  PLUGIN(mirror)                   \
  PLUGIN(glass)                    \
  PLUGIN(uber)                     \
  PLUGIN(substrate)                \
  PLUGIN(translucent)              \
  PLUGIN(mixMaterial)              \
  PLUGIN(disney)                   \
  PLUGIN(hair)                     \
  PLUGIN(fourier)                  \
  PLUGIN(subsurface)               \
  PLUGIN(kdSubsurface)

LAMPYRIS_REGISTRY(materialRegistry, "material", MaterialRegistry, LAMPYRIS_MATERIALS)
