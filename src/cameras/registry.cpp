// SPDX-License-Identifier: Apache-2.0
#include "cameras/registry.h"

// One line a plugin: n stands for the entry function nPlugin().
#define LAMPYRIS_CAMERAS(PLUGIN)

LAMPYRIS_REGISTRY(cameraRegistry, "camera", CameraRegistry, LAMPYRIS_CAMERAS)
