// SPDX-License-Identifier: Apache-2.0
#include <glm/matrix.hpp>

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
    determinant_ = std::abs(glm::determinant(glm::dmat3(cameraToWorld().inverseMatrix())));
  }

  bool projects() const override { return true; }
  std::optional<CameraView> project(const Vec3& p, const Vec2& lens, float time) const override {
    CameraView view;
    const Vec3 local = cameraToWorld().inverse().affinePoint(p);
    const Vec3 start = hasLens() ? lensPoint(lens) : Vec3(0);
    const Vec3 d = local - start;
    if (!(d.z > 0)) return std::nullopt;
    // Where the ray passes the plane z = 1 of a pinhole that looks at the same point in focus.
    const float ahead = hasLens() ? focalDistance_ : 1.f;
    view.film = screen_.film(Vec2(start + d * (ahead / d.z)) / ahead);
    view.lens = cameraToWorld().affinePoint(start);
    view.pixelsPerSteradian = pixelsPerSteradian(normalize(p - view.lens), time);
    if (!(view.pixelsPerSteradian > 0) || !isFinite(Vec3(view.film, 0))) return std::nullopt;
    return view;
  }
  float pixelsPerSteradian(const Vec3& d, float) const override {
    // dA = dω / cos³ on the plane z = 1; a transform A that is no rotation changes solid angles,
    // dω = |det A| / |A d|³ dω'. Together the length of A d drops out.
    const Vec3 local = cameraToWorld().inverse().vector(d);
    if (!(local.z > 0)) return 0;
    const double z = static_cast<double>(local.z);
    const double pixel =
        std::abs(static_cast<double>(screen_.step.x) * static_cast<double>(screen_.step.y));
    const auto density = static_cast<float>(determinant_ / (z * z * z * pixel));
    return std::isfinite(density) ? density : 0.f;
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

 private:
  double determinant_ = 1;  ///< of worldToCamera's linear part, absolute
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
