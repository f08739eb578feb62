// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>

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

  /// For rays that are `factor` times as far apart as pixels.
  void scaleDifferentials(float factor) {
    RayDifferential& d = differential;
    d.xOrigin = ray.o + (d.xOrigin - ray.o) * factor;
    d.yOrigin = ray.o + (d.yOrigin - ray.o) * factor;
    d.xDirection = ray.d + (d.xDirection - ray.d) * factor;
    d.yDirection = ray.d + (d.yDirection - ray.d) * factor;
  }
};

/// How a point of the scene shows on the film, through one point of the lens.
struct CameraView {
  Vec3 lens{0};  ///< world space
  Vec2 film{0};  ///< in pixels, may lie beyond the image
  /// How many pixels of the film a unit of solid angle takes up, seen from the lens point: the
  /// density of directions of camera rays if one starts in each pixel. Light with intensity I from
  /// there adds I × this / distance² to the pixel (the importance of Veach 1997, §8.3).
  float pixelsPerSteradian = 0;
};

class Camera {
 public:
  virtual ~Camera() = default;
  virtual CameraRay generate(const CameraSample& sample) const = 0;

  /// True if project() works: paths from lights can be led to the camera.
  virtual bool projects() const { return false; }
  /// Where the point `p` shows through the lens point drawn with `lens`, in [0, 1)², at the time
  /// `time` (as in Ray). None if it does not: behind the camera.
  virtual std::optional<CameraView> project(const Vec3& p, const Vec2& lens, float time) const {
    return (void)p, (void)lens, (void)time, std::nullopt;
  }
  /// CameraView::pixelsPerSteradian about the direction `d` (unit) of a camera ray.
  virtual float pixelsPerSteradian(const Vec3& d, float time) const {
    return (void)d, (void)time, 0.f;
  }
};

struct CameraContext : BuildContext {
  Transform cameraToWorld;
  Int2 resolution{0};       ///< of the whole image
  float filmDiagonal = 35;  ///< in millimetres
};

using CameraRegistry = Registry<Camera, CameraContext>;

}  // namespace lampyris
