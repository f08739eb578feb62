// SPDX-License-Identifier: Apache-2.0
/// From a scene file to objects.
#pragma once

#include <memory>
#include <set>
#include <string>
#include <vector>

#include "base/integrator.h"
#include "core/statistics.h"

namespace lampyris {

/// Everything that a render needs, made from a scene file.
struct RenderJob {
  Scene scene;
  std::unique_ptr<Camera> camera;
  std::unique_ptr<Sampler> sampler;
  std::unique_ptr<Film> film;
  std::unique_ptr<Integrator> integrator;
  std::set<std::string> files;  ///< that the scene names, but for scene files and spectra
};

/// What the command line changes of a scene.
struct BuildOptions {
  /// `-D kind.parameter=value`, kind one of integrator, sampler, film, camera, filter,
  /// lightsampler.
  std::vector<std::pair<std::string, std::string>> overrides;
  int samplesPerPixel = 0;  ///< > 0: instead of the sampler's
  uint64_t seed = 0;
  std::string outputPath;  ///< not empty: instead of the film's filename
  /// Not empty: x0, x1, y0, y1 in [0, 1] instead of the film's cropwindow.
  std::vector<float> cropWindow;
};

/// Reads and builds a scene. Throws SceneError (resolve its location with `files`) and IoError;
/// warnings go to `diagnostics`.
std::unique_ptr<RenderJob> loadScene(const std::string& path, const BuildOptions& options,
                                     SourceFiles& files, Diagnostics& diagnostics,
                                     Statistics& statistics);
/// The same of a text; relative file names count from `folder`.
std::unique_ptr<RenderJob> loadSceneText(const std::string& text, const std::string& folder,
                                         const BuildOptions& options, SourceFiles& files,
                                         Diagnostics& diagnostics, Statistics& statistics);

/// Every registry, by its kind: for help-scene, checks and tests.
std::vector<const RegistryInfo*> allRegistries();

}  // namespace lampyris
