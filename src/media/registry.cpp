// SPDX-License-Identifier: Apache-2.0
#include "media/registry.h"

// One line a plugin: n stands for the entry function nPlugin().
#define LAMPYRIS_MEDIA(PLUGIN) \
  PLUGIN(homogeneousMedium)    \
  PLUGIN(heterogeneousMedium)

LAMPYRIS_REGISTRY(mediumRegistry, "medium", MediumRegistry, LAMPYRIS_MEDIA)
