// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/ray.h"
#include "base/texture.h"
#include "core/registry.h"

namespace lampyris {

struct CameraSample {
  Vec2 film{0};  ///< in pixels, (0, 0) at the top left corner of the image
  Vec2 lens{0.5f};
  float time = 0;  ///< in [0, 1): of the shutter interval
};

struct CameraRay {
  Ray ray;  ///< unit direction, world space
  RayDifferential differential;
  float weight = 1;  ///< 0: the lens lets nothing through
};

class Camera {
 public:
  virtual ~Camera() = default;
  virtual CameraRay generate(const CameraSample& sample) const = 0;
};

struct CameraContext : BuildContext {
  Transform cameraToWorld;
  Int2 resolution{0};       ///< of the whole image
  float filmDiagonal = 35;  ///< in millimetres
};

using CameraRegistry = Registry<Camera, CameraContext>;

}  // namespace lampyris
