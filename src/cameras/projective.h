// SPDX-License-Identifier: Apache-2.0
/// What pbrt-v3's projective cameras share: shutter, screen window, lens.
#pragma once

#include <optional>
#include <vector>

#include "base/camera.h"

namespace lampyris {

struct ShutterParameters {
  float shutterOpen = 0, shutterClose = 1;
  void declare(Declaration& d);
};

struct Shutter {
  float open = 0, close = 1;
  float at(float u) const { return (1 - u) * open + u * close; }
};
/// Swaps the times, with a warning, if the shutter closes before it opens.
Shutter makeShutter(const ShutterParameters& p, const CameraContext& context);

struct ProjectiveParameters : ShutterParameters {
  float lensRadius = 0, focalDistance = 1e6f;
  std::optional<float> frameAspectRatio;
  std::vector<float> screenWindow;
  void declare(Declaration& d);
};

/// Film positions (pixels, y down) to the screen (y up): origin + film · step.
struct Screen {
  Vec2 origin{0}, step{0};
  Vec2 at(const Vec2& film) const { return origin + film * step; }
  Vec2 film(const Vec2& at) const { return (at - origin) / step; }
};
/// The window defaults to [−1, 1] along the image's shorter side. Throws SceneError if it is empty.
Screen makeScreen(const ProjectiveParameters& p, const CameraContext& context);

/// Throws SceneError if the camera's transformation cannot be inverted.
void checkCameraTransform(const CameraContext& context);

/// A ray in camera space with the two beside it; directions of any length.
struct LocalRay {
  Vec3 o{0}, d{0, 0, 1}, xOrigin{0}, xDirection{0}, yOrigin{0}, yDirection{0};
};
CameraRay toWorld(const Transform& cameraToWorld, const LocalRay& ray, float time);

/// A camera that projects the scene onto a screen; how, its subclass says.
class ProjectiveCamera : public Camera {
 public:
  CameraRay generate(const CameraSample& sample) const final {
    return toWorld(cameraToWorld_, localRay(sample), shutter_.at(sample.time));
  }

 protected:
  ProjectiveCamera(const ProjectiveParameters& p, const CameraContext& context);
  virtual LocalRay localRay(const CameraSample& sample) const = 0;
  bool hasLens() const { return lensRadius_ > 0; }
  /// A point of the lens.
  Vec3 lensPoint(const Vec2& u) const;
  const Transform& cameraToWorld() const { return cameraToWorld_; }

  Screen screen_;
  float focalDistance_;

 private:
  Transform cameraToWorld_;
  Shutter shutter_;
  float lensRadius_;
};

}  // namespace lampyris
