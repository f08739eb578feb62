// SPDX-License-Identifier: Apache-2.0
#include "cameras/registry.h"

// One line a plugin: n stands for the entry function nPlugin().
// clang-format off
#define LAMPYRIS_CAMERAS(PLUGIN) \
  PLUGIN(perspectiveCamera)      \
  PLUGIN(orthographicCamera)     \
  PLUGIN(environmentCamera)      \
  PLUGIN(realisticCamera)
// clang-format on

LAMPYRIS_REGISTRY(cameraRegistry, "camera", CameraRegistry, LAMPYRIS_CAMERAS)
