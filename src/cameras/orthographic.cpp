// SPDX-License-Identifier: Apache-2.0
#include "cameras/projective.h"

namespace lampyris {

namespace {

struct OrthographicParameters : ProjectiveParameters {};

/// Parallel rays along z. As in pbrt-v3 a lens sits at the camera's origin, so that with one all
/// rays start on it and go through their point of the plane in focus.
class OrthographicCamera final : public ProjectiveCamera {
 public:
  OrthographicCamera(const OrthographicParameters& p, const CameraContext& context)
      : ProjectiveCamera(p, context) {}

 protected:
  LocalRay localRay(const CameraSample& sample) const override {
    const Vec3 p(screen_.at(sample.film), 0);
    const Vec3 right(screen_.step.x, 0, 0), down(0, screen_.step.y, 0), ahead(0, 0, 1);
    if (!hasLens()) return {p, ahead, p + right, ahead, p + down, ahead};
    const Vec3 lens = lensPoint(sample.lens), focus = p + focalDistance_ * ahead;
    return {lens, focus - lens, lens, focus + right - lens, lens, focus + down - lens};
  }
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
