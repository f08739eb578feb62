// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <glm/matrix.hpp>
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

  bool projects() const override { return camera_->projects(); }
  std::optional<CameraView> project(const Vec3& p, const Vec2& lens, float time) const override {
    const Transform toWorld = cameraToWorld_.at(time);
    auto view = camera_->project(toWorld.inverse().affinePoint(p), lens, time);
    if (!view) return view;
    view->lens = toWorld.affinePoint(view->lens);
    view->pixelsPerSteradian = pixelsPerSteradian(normalize(p - view->lens), time);
    return view;
  }
  float pixelsPerSteradian(const Vec3& d, float time) const override {
    const Transform toCamera = cameraToWorld_.at(time).inverse();
    const Vec3 local = toCamera.vector(d);
    const double size = static_cast<double>(length(local));
    const double stretch =
        std::abs(glm::determinant(glm::dmat3(toCamera.matrix()))) / (size * size * size);
    return static_cast<float>(stretch) * camera_->pixelsPerSteradian(normalize(local), time);
  }

 private:
  std::unique_ptr<Camera> camera_;
  AnimatedTransform cameraToWorld_;
};

}  // namespace lampyris
