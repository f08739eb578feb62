// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/camera.h"

namespace lampyris {

const CameraRegistry& cameraRegistry();

}  // namespace lampyris
