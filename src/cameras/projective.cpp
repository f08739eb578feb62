// SPDX-License-Identifier: Apache-2.0
#include "cameras/projective.h"

#include <fmt/format.h>

#include "core/sampling.h"

namespace lampyris {

void ShutterParameters::declare(Declaration& d) {
  d.add("shutteropen", shutterOpen, "Time at which the shutter opens.")
      .rangeIs("any; swapped if they do not ascend");
  d.add("shutterclose", shutterClose, "Time at which the shutter closes.")
      .rangeIs("any; swapped if they do not ascend");
}

Shutter makeShutter(const ShutterParameters& p, const CameraContext& context) {
  if (p.shutterClose >= p.shutterOpen) return {p.shutterOpen, p.shutterClose};
  context.diagnostics.warn(context.location,
                           fmt::format("\"shutterclose\" {} is before \"shutteropen\" {}; they are "
                                       "swapped",
                                       p.shutterClose, p.shutterOpen));
  return {p.shutterClose, p.shutterOpen};
}

void ProjectiveParameters::declare(Declaration& d) {
  ShutterParameters::declare(d);
  d.add("lensradius", lensRadius, "Radius of the lens; 0: everything is in focus.").atLeast(0);
  d.add("focaldistance", focalDistance, "Distance of the plane in focus.").atLeast(1e-30);
  d.add("frameaspectratio", frameAspectRatio, "Width over height of the screen window.")
      .range(1e-4, 1e4)
      .defaultIs("xresolution / yresolution");
  d.add("screenwindow", screenWindow, "Bounds of the screen: x0 x1 y0 y1.")
      .defaultIs("[-1, 1] along the shorter side")
      .rangeIs("any, x0 ≠ x1 and y0 ≠ y1");
}

Screen makeScreen(const ProjectiveParameters& p, const CameraContext& context) {
  const Vec2 resolution(context.resolution);
  const float aspect = p.frameAspectRatio.value_or(resolution.x / resolution.y);
  Vec2 min(-1, -1), max(1, 1);
  if (aspect > 1) {
    min.x = -aspect, max.x = aspect;
  } else {
    min.y = -1 / aspect, max.y = 1 / aspect;
  }
  const auto& window = p.screenWindow;
  if (!window.empty()) {
    if (window.size() != 4)
      throw SceneError(context.location,
                       fmt::format("parameter \"screenwindow\": expected 4 values (x0 x1 y0 y1), "
                                   "got {}",
                                   window.size()));
    // A window with swapped ends mirrors the image, which is legitimate; an empty one is not.
    if (window[0] == window[1] || window[2] == window[3])
      throw SceneError(context.location, "parameter \"screenwindow\": the window is empty");
    min = {window[0], window[2]}, max = {window[1], window[3]};
  }
  return {{min.x, max.y}, Vec2(max.x - min.x, min.y - max.y) / resolution};
}

void checkCameraTransform(const CameraContext& context) {
  const auto& m = context.cameraToWorld.matrix();
  bool finite = true;
  for (int c = 0; c < 4; ++c)
    for (int r = 0; r < 4; ++r) finite = finite && std::isfinite(m[c][r]);
  if (!finite || context.cameraToWorld.isSingular())
    throw SceneError(context.location,
                     "the camera's transformation cannot be inverted; in LookAt, eye and target "
                     "must differ and the up vector must not point along the view");
}

CameraRay toWorld(const Transform& cameraToWorld, const LocalRay& ray, float time) {
  CameraRay out;
  out.ray.o = cameraToWorld.affinePoint(ray.o);
  out.ray.d = normalize(cameraToWorld.vector(ray.d));
  out.ray.time = time;
  out.differential = {
      cameraToWorld.affinePoint(ray.xOrigin), normalize(cameraToWorld.vector(ray.xDirection)),
      cameraToWorld.affinePoint(ray.yOrigin), normalize(cameraToWorld.vector(ray.yDirection))};
  return out;
}

ProjectiveCamera::ProjectiveCamera(const ProjectiveParameters& p, const CameraContext& context)
    : screen_(makeScreen(p, context)),
      focalDistance_(p.focalDistance),
      cameraToWorld_(context.cameraToWorld),
      shutter_(makeShutter(p, context)),
      lensRadius_(p.lensRadius) {}

Vec3 ProjectiveCamera::lensPoint(const Vec2& u) const {
  return {lensRadius_ * sampleConcentricDisk(u), 0};
}

}  // namespace lampyris
