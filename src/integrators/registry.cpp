// SPDX-License-Identifier: Apache-2.0
#include "integrators/registry.h"

// One line a plugin: n stands for the entry function nPlugin().
#define LAMPYRIS_INTEGRATORS(PLUGIN) \
  PLUGIN(path)                       \
  PLUGIN(pathTree)                   \
  PLUGIN(volpath)                    \
  PLUGIN(guidedPath)                 \
  PLUGIN(directLighting)             \
  PLUGIN(whitted)                    \
  PLUGIN(ambientOcclusion)           \
  PLUGIN(bdpt)                       \
  PLUGIN(sppm)                       \
  PLUGIN(mlt)

LAMPYRIS_REGISTRY(integratorRegistry, "integrator", IntegratorRegistry, LAMPYRIS_INTEGRATORS)
