// SPDX-License-Identifier: Apache-2.0
#include "film/filter_registry.h"

// One line a plugin: n stands for the entry function nPlugin().
// clang-format off
#define LAMPYRIS_FILTERS(PLUGIN) \
  PLUGIN(boxFilter)              \
  PLUGIN(triangleFilter)         \
  PLUGIN(gaussianFilter)         \
  PLUGIN(mitchellFilter)         \
  PLUGIN(sincFilter)
// clang-format on

LAMPYRIS_REGISTRY(filterRegistry, "filter", FilterRegistry, LAMPYRIS_FILTERS)
