// SPDX-License-Identifier: Apache-2.0
#include "lights/area_registry.h"

// One line a plugin: n stands for the entry function nPlugin().
#define LAMPYRIS_AREA_LIGHTS(PLUGIN) PLUGIN(diffuseAreaLight)

LAMPYRIS_REGISTRY(areaLightRegistry, "area light", AreaLightRegistry, LAMPYRIS_AREA_LIGHTS)
