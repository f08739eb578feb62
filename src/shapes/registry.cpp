// SPDX-License-Identifier: Apache-2.0
#include "shapes/registry.h"

// One line a plugin: n stands for the entry function nPlugin().
#define LAMPYRIS_SHAPES(PLUGIN) \
  PLUGIN(cone)                  \
  PLUGIN(curve)                 \
  PLUGIN(cylinder)              \
  PLUGIN(disk)                  \
  PLUGIN(heightfield)           \
  PLUGIN(hyperboloid)           \
  PLUGIN(loopsubdiv)            \
  PLUGIN(nurbs)                 \
  PLUGIN(paraboloid)            \
  PLUGIN(plymesh)               \
  PLUGIN(sphere)                \
  PLUGIN(trianglemesh)

LAMPYRIS_REGISTRY(shapeRegistry, "shape", ShapeRegistry, LAMPYRIS_SHAPES)
