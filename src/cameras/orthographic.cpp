// SPDX-License-Identifier: Apache-2.0
#include "cameras/projective.h"
#include "core/sampling.h"

namespace lampyris {

namespace {

struct OrthographicParameters : ProjectiveParameters {};

/// Parallel rays along z. As in pbrt-v3 a lens sits at the camera's origin, so that with one all
/// rays start on it and go through their point of the plane in focus.
class OrthographicCamera final : public Camera {
 public:
  OrthographicCamera(const OrthographicParameters& p, const CameraContext& context)
      : cameraToWorld_(context.cameraToWorld),
        shutter_(makeShutter(p, context)),
        screen_(makeScreen(p, context)),
        lensRadius_(p.lensRadius),
        focalDistance_(p.focalDistance) {}

  CameraRay generate(const CameraSample& sample) const override {
    const Vec3 p(screen_.at(sample.film), 0);
    const Vec3 right(screen_.step.x, 0, 0), down(0, screen_.step.y, 0), ahead(0, 0, 1);
    LocalRay ray;
    if (lensRadius_ > 0) {
      const Vec3 lens(lensRadius_ * sampleConcentricDisk(sample.lens), 0);
      const Vec3 focus = p + focalDistance_ * ahead;
      ray = {lens, focus - lens, lens, focus + right - lens, lens, focus + down - lens};
    } else {
      ray = {p, ahead, p + right, ahead, p + down, ahead};
    }
    return toWorld(cameraToWorld_, ray, shutter_.at(sample.time));
  }

 private:
  Transform cameraToWorld_;
  Shutter shutter_;
  Screen screen_;
  float lensRadius_, focalDistance_;
};

std::unique_ptr<Camera> create(const OrthographicParameters& p, const CameraContext& context) {
  checkCameraTransform(context);
  return std::make_unique<OrthographicCamera>(p, context);
}

}  // namespace

CameraRegistry::Entry orthographicCameraPlugin() {
  return makePlugin("orthographic", "Parallel projection.", create);
}

}  // namespace lampyris
