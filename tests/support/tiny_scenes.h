// SPDX-License-Identifier: Apache-2.0
/// Small scenes from text, built and rendered in memory. For tests that link lampyris_scene.
#pragma once

#include <string>
#include <vector>

#include "scene/builder.h"

namespace lampyris::test {

/// A scene that is built, and what it said meanwhile. Throws what the builder throws.
class TinyScene {
 public:
  explicit TinyScene(const std::string& text, const BuildOptions& options = {})
      : diagnostics_(files_, [this](const std::string& t) { warnings_ += t + "\n"; }),
        job_(loadSceneText(text, ".", options, files_, diagnostics_, statistics_)) {}

  /// Renders `samples` a pixel (0: as many as the sampler says); returns what all pixels have.
  uint64_t render(uint64_t samples = 0) {
    RenderOptions options;
    options.sampleCount = samples;
    return render(options);
  }
  uint64_t render(const RenderOptions& options) {
    RenderContext context{job_->scene, *job_->camera, *job_->sampler,
                          *job_->film, options,       statistics_};
    return job_->integrator->render(context);
  }

  RenderJob& job() { return *job_; }
  Film& film() { return *job_->film; }
  Statistics& statistics() { return statistics_; }
  const std::string& warnings() const { return warnings_; }

  std::vector<Rgb> pixels() const {
    std::vector<Rgb> all;
    const PixelBounds b = job_->film->bounds();
    for (int y = b.min.y; y < b.max.y; ++y)
      for (int x = b.min.x; x < b.max.x; ++x) all.push_back(job_->film->pixel({x, y}));
    return all;
  }
  /// The green channel of every pixel: tests of radiance use grey scenes.
  std::vector<double> greens() const {
    std::vector<double> all;
    for (const Rgb& c : pixels()) all.push_back(static_cast<double>(c.g));
    return all;
  }
  /// Samples that were not finite or negative.
  double badSamples() const {
    return statistics_.value("bad samples", "not a number") +
           statistics_.value("bad samples", "infinite") +
           statistics_.value("bad samples", "negative");
  }

 private:
  SourceFiles files_;
  Statistics statistics_;
  std::string warnings_;
  Diagnostics diagnostics_;
  std::unique_ptr<RenderJob> job_;
};

/// How a tiny scene is looked at and rendered.
struct TinyView {
  std::string integrator = R"("path")";  ///< with its parameters
  std::string sampler = R"("random" "integer pixelsamples" 16)";
  std::string lookAt = "0 0 5  0 0 0  0 1 0";
  std::string camera = R"("orthographic" "float screenwindow" [-0.001 0.001 -0.001 0.001])";
  int resolution = 8;
};

/// A scene file of `world`; the box filter, so that pixels are independent.
inline std::string tinyScene(const TinyView& view, const std::string& world) {
  const std::string size = std::to_string(view.resolution);
  return "Integrator " + view.integrator + "\nSampler " + view.sampler +
         "\nPixelFilter \"box\"\nFilm \"image\" \"integer xresolution\" " + size +
         " \"integer yresolution\" " + size + " \"string filename\" \"tiny.pfm\"\nLookAt " +
         view.lookAt + "\nCamera " + view.camera + "\nWorldBegin\n" + world + "\nWorldEnd\n";
}

/// A square in the plane z = 0 (normal +z) of the given half width.
inline std::string square(float halfWidth) {
  const std::string p = std::to_string(halfWidth), m = "-" + p;
  return "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point P\" [" + m + " " + m +
         " 0 " + p + " " + m + " 0 " + p + " " + p + " 0 " + m + " " + p + " 0]\n";
}

inline std::string matte(float albedo) {
  const std::string a = std::to_string(albedo);
  return "Material \"matte\" \"rgb Kd\" [" + a + " " + a + " " + a + "]\n";
}

}  // namespace lampyris::test
