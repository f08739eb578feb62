// SPDX-License-Identifier: Apache-2.0
#include "cameras/projective.h"

namespace lampyris {

namespace {

constexpr double kMinFov = 1e-4, kMaxFov = 179.99;

struct PerspectiveParameters : ProjectiveParameters {
  float fov = 90;
  std::optional<float> halfFov;
  void declare(Declaration& d) {
    ProjectiveParameters::declare(d);
    d.add("fov", fov, "Angle of view across the shorter side of the image, in degrees.")
        .range(kMinFov, kMaxFov);
    d.add("halffov", halfFov, "Half of it; counts instead of fov if it is > 0.")
        .range(-1e6, kMaxFov / 2);
  }
};

/// A pinhole, or a thin lens focused on the plane z = focalDistance.
class PerspectiveCamera final : public ProjectiveCamera {
 public:
  PerspectiveCamera(const PerspectiveParameters& p, const CameraContext& context)
      : ProjectiveCamera(p, context) {
    const bool half = p.halfFov.value_or(-1) > 0;
    const double degrees = std::max(static_cast<double>(half ? 2 * *p.halfFov : p.fov), kMinFov);
    const auto tangent = static_cast<float>(std::tan(degrees * (3.14159265358979323846 / 360)));
    screen_.origin *= tangent;
    screen_.step *= tangent;
  }

 protected:
  LocalRay localRay(const CameraSample& sample) const override {
    // The plane z = 1; the screen is scaled to it.
    const Vec3 d(screen_.at(sample.film), 1);
    const Vec3 right(screen_.step.x, 0, 0), down(0, screen_.step.y, 0);
    const Vec3 o(0);
    if (!hasLens()) return {o, d, o, d + right, o, d + down};
    const Vec3 lens = lensPoint(sample.lens);
    return {lens, focalDistance_ * d - lens,         lens, focalDistance_ * (d + right) - lens,
            lens, focalDistance_ * (d + down) - lens};
  }
};

std::unique_ptr<Camera> create(const PerspectiveParameters& p, const CameraContext& context) {
  checkCameraTransform(context);
  return std::make_unique<PerspectiveCamera>(p, context);
}

}  // namespace

CameraRegistry::Entry perspectiveCameraPlugin() {
  return makePlugin("perspective", "A pinhole camera, or one with a thin lens.", create);
}

}  // namespace lampyris
