// SPDX-License-Identifier: Apache-2.0
#include "film/filter_registry.h"

// One line a plugin: n stands for the entry function nPlugin().
#define LAMPYRIS_FILTERS(PLUGIN)

LAMPYRIS_REGISTRY(filterRegistry, "filter", FilterRegistry, LAMPYRIS_FILTERS)
