// SPDX-License-Identifier: Apache-2.0
// A camera with a lens of many elements (Kolb et al. 1995, "A Realistic Camera Model for Computer
// Graphics"; Steinert et al. 2011, "General Spectral Camera Lens Simulation", for the exit pupil's
// boxes), with pbrt-v3's conventions: lengths in metres, the film seen from the front.
#include <fmt/format.h>

#include "cameras/exit_pupil.h"
#include "cameras/lens_file.h"
#include "cameras/projective.h"
#include "core/source.h"

namespace lampyris {

namespace {

struct RealisticParameters : ShutterParameters {
  std::string lensFile;
  float apertureDiameter = 1, focusDistance = 10;
  bool simpleWeighting = true;

  void declare(Declaration& d) {
    ShutterParameters::declare(d);
    d.add("lensfile", lensFile, "The file that describes the lens.").rangeIs("any file name");
    d.add("aperturediameter", apertureDiameter, "Diameter of the aperture stop, in millimetres.")
        .atLeast(1e-6);
    d.add("focusdistance", focusDistance, "Distance from the film that is in focus, in metres.")
        .atLeast(1e-6);
    d.add("simpleweighting", simpleWeighting,
          "True: exposure does not depend on the size of the aperture. False: radiometry.");
  }
};

class RealisticCamera final : public Camera {
 public:
  RealisticCamera(const RealisticParameters& p, LensSystem lens, const CameraContext& context)
      : lens_(std::move(lens)),
        cameraToWorld_(context.cameraToWorld),
        shutter_(makeShutter(p, context)) {
    const double diagonal = filmDiagonal(context);
    pupil_ = ExitPupil(lens_, diagonal / 2);
    const glm::dvec2 resolution(context.resolution);
    pixel_ = diagonal / glm::length(resolution);
    corner_ = 0.5 * pixel_ * resolution;
    const auto normalise = p.simpleWeighting ? 1 / pupil_.box(0).area()
                                             : static_cast<double>(shutter_.close - shutter_.open) /
                                                   (lens_.rearZ() * lens_.rearZ());
    weight_ = normalise;
  }

  CameraRay generate(const CameraSample& sample) const override {
    CameraRay out;
    const auto ray = localRay(sample.film, sample.lens, out.weight);
    if (!ray) {
      out.weight = 0;
      return out;
    }
    const Vec3 o(ray->o), d(ray->d);
    LocalRay local{o, d, o, d, o, d};
    offsetRay(sample, {1, 0}, local.xOrigin, local.xDirection);
    offsetRay(sample, {0, 1}, local.yOrigin, local.yDirection);
    const float weight = out.weight;
    out = toWorld(cameraToWorld_, local, shutter_.at(sample.time));
    out.weight = weight;
    return out;
  }

  static double filmDiagonal(const CameraContext& context) {
    return 0.001 * static_cast<double>(context.filmDiagonal);
  }

 private:
  std::optional<LensRay> localRay(const Vec2& film, const Vec2& lens, float& weight) const {
    // The image on the film is upside down and mirrored.
    const glm::dvec2 q = pixel_ * glm::dvec2(film) - corner_;
    const DVec3 from(-q.x, q.y, 0);
    const double distance = glm::length(q);
    const PupilBox& box = pupil_.box(distance);
    const glm::dvec2 p = box.min + glm::dvec2(lens) * (box.max - box.min);
    // Boxes belong to film points on the x axis.
    const glm::dvec2 turn = distance > 0 ? glm::dvec2(from) / distance : glm::dvec2(1, 0);
    const DVec3 to(turn.x * p.x - turn.y * p.y, turn.y * p.x + turn.x * p.y, lens_.rearZ());
    const double cosine = lens_.rearZ() / glm::length(to - from);
    weight = static_cast<float>(sqr(cosine * cosine) * box.area() * weight_);
    return lens_.traceFromFilm({from, to - from});
  }

  /// The ray a pixel further, from what a twentieth of a pixel changes; where the lens stops either
  /// way, the ray itself is kept.
  void offsetRay(const CameraSample& sample, const Vec2& pixel, Vec3& o, Vec3& d) const {
    for (const float step : {0.05f, -0.05f}) {
      float weight = 0;
      const auto ray = localRay(sample.film + step * pixel, sample.lens, weight);
      if (!ray) continue;
      o += (Vec3(ray->o) - o) / step;
      d += (Vec3(ray->d) - d) / step;
      return;
    }
  }

  LensSystem lens_;
  ExitPupil pupil_;
  Transform cameraToWorld_;
  Shutter shutter_;
  double pixel_ = 0;      ///< side of a pixel on the film, in metres
  glm::dvec2 corner_{0};  ///< half the film's size
  double weight_ = 1;     ///< of cos⁴ times the area of the pupil's box
};

/// Sets the diameter of the aperture stop, as far as it opens.
void setAperture(std::vector<LensElement>& elements, const RealisticParameters& p,
                 const CameraContext& context) {
  const double radius = static_cast<double>(p.apertureDiameter) * 0.001 / 2;
  bool found = false;
  for (LensElement& e : elements) {
    if (!e.isStop()) continue;
    found = true;
    if (radius > e.apertureRadius)
      context.diagnostics.warn(
          context.location,
          fmt::format("\"aperturediameter\" {} is wider than the stop of {}, which opens to {}",
                      p.apertureDiameter, p.lensFile, 2000 * e.apertureRadius));
    e.apertureRadius = std::min(radius, e.apertureRadius);
  }
  if (!found)
    context.diagnostics.warn(
        context.location,
        fmt::format("{} has no aperture stop (an element of radius 0): \"aperturediameter\" has no "
                    "effect",
                    p.lensFile));
}

std::unique_ptr<Camera> create(const RealisticParameters& p, const CameraContext& context) {
  checkCameraTransform(context);
  if (p.lensFile.empty())
    throw SceneError(context.location, "realistic camera: \"string lensfile\" is missing");
  if (!(context.filmDiagonal > 0) || !std::isfinite(context.filmDiagonal))
    throw SceneError(context.location, "realistic camera: the film's \"diagonal\" must be > 0");
  const std::string path = context.resolvePath(p.lensFile);
  const MappedFile file(path);
  try {
    std::vector<LensElement> elements = readLens(file.text());
    setAperture(elements, p, context);
    LensSystem lens(std::move(elements));
    // pbrt-v3's distance from the axis for rays that tell where the lens focuses.
    lens.focus(p.focusDistance, 0.001 * RealisticCamera::filmDiagonal(context));
    return std::make_unique<RealisticCamera>(p, std::move(lens), context);
  } catch (const SceneError&) {
    throw;
  } catch (const std::runtime_error& e) {
    throw SceneError(context.location, fmt::format("{}: {}", path, e.what()));
  }
}

}  // namespace

CameraRegistry::Entry realisticCameraPlugin() {
  return makePlugin("realistic", "A camera with a lens of many elements, read from a file.",
                    create);
}

}  // namespace lampyris
