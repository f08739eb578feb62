// SPDX-License-Identifier: Apache-2.0
#include "cameras/projective.h"

namespace lampyris {

namespace {

struct EnvironmentParameters : ShutterParameters {
  void declare(Declaration& d) {
    ShutterParameters::declare(d);
    for (const char* name : {"lensradius", "focaldistance", "frameaspectratio", "screenwindow"})
      d.ignored(name, "the environment camera sees all directions, sharply");
  }
};

/// All directions from one point: y is up, longitude along the image's x, colatitude along its y.
class EnvironmentCamera final : public Camera {
 public:
  EnvironmentCamera(const EnvironmentParameters& p, const CameraContext& context)
      : cameraToWorld_(context.cameraToWorld),
        shutter_(makeShutter(p, context)),
        step_(Vec2(2 * kPi, kPi) / Vec2(context.resolution)) {}

  CameraRay generate(const CameraSample& sample) const override {
    LocalRay ray;
    ray.d = direction(sample.film);
    ray.xDirection = direction(sample.film + Vec2(1, 0));
    ray.yDirection = direction(sample.film + Vec2(0, 1));
    return toWorld(cameraToWorld_, ray, shutter_.at(sample.time));
  }

 private:
  Vec3 direction(const Vec2& film) const {
    const float phi = step_.x * film.x, theta = step_.y * film.y;
    return {std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi)};
  }

  Transform cameraToWorld_;
  Shutter shutter_;
  Vec2 step_;  ///< radians a pixel
};

std::unique_ptr<Camera> create(const EnvironmentParameters& p, const CameraContext& context) {
  checkCameraTransform(context);
  return std::make_unique<EnvironmentCamera>(p, context);
}

}  // namespace

CameraRegistry::Entry environmentCameraPlugin() {
  return makePlugin("environment", "All directions, as a latitude-longitude image.", create);
}

}  // namespace lampyris
