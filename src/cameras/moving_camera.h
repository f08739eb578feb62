// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>

#include "base/camera.h"
#include "core/animated_transform.h"

namespace lampyris {

/// Moves another camera, which stands in camera space.
class MovingCamera final : public Camera {
 public:
  MovingCamera(std::unique_ptr<Camera> camera, const AnimatedTransform& cameraToWorld)
      : camera_(std::move(camera)), cameraToWorld_(cameraToWorld) {}

  CameraRay generate(const CameraSample& sample) const override {
    CameraRay r = camera_->generate(sample);
    const Transform toWorld = cameraToWorld_.at(r.ray.time);
    r.ray.o = toWorld.affinePoint(r.ray.o);
    r.ray.d = normalize(toWorld.vector(r.ray.d));
    RayDifferential& d = r.differential;
    d.xOrigin = toWorld.affinePoint(d.xOrigin);
    d.yOrigin = toWorld.affinePoint(d.yOrigin);
    d.xDirection = normalize(toWorld.vector(d.xDirection));
    d.yDirection = normalize(toWorld.vector(d.yDirection));
    return r;
  }

 private:
  std::unique_ptr<Camera> camera_;
  AnimatedTransform cameraToWorld_;
};

}  // namespace lampyris
