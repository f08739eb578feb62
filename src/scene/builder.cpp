// SPDX-License-Identifier: Apache-2.0
#include "scene/builder.h"

#include <chrono>
#include <filesystem>

#include "cameras/registry.h"
#include "film/film_registry.h"
#include "film/filter_registry.h"
#include "integrators/registry.h"
#include "lightdistributions/registry.h"
#include "lights/area_registry.h"
#include "lights/registry.h"
#include "materials/registry.h"
#include "media/registry.h"
#include "samplers/registry.h"
#include "scene/build_state.h"
#include "scene/parser.h"
#include "shapes/registry.h"
#include "textures/float_registry.h"
#include "textures/spectrum_registry.h"

namespace lampyris {

namespace {

double seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

std::unique_ptr<RenderJob> load(uint16_t file, const std::string& folder,
                                const BuildOptions& options, SourceFiles& files,
                                Diagnostics& diagnostics, Statistics& statistics) {
  const double start = seconds();
  const Description description = parseScene(file, folder, files, diagnostics);
  const double parsed = seconds();
  statistics.set("scene", "parse seconds", parsed - start);

  auto job = std::make_unique<RenderJob>();
  BuildState state(description, options, folder, files, diagnostics, statistics, *job);
  buildView(state);
  const IntegratorChoice integrator = chooseIntegrator(state);
  buildWorld(state);
  buildIntegrator(state, integrator);
  statistics.set("scene", "build seconds", seconds() - parsed);
  return job;
}

}  // namespace

std::unique_ptr<RenderJob> loadScene(const std::string& path, const BuildOptions& options,
                                     SourceFiles& files, Diagnostics& diagnostics,
                                     Statistics& statistics) {
  const std::string folder = std::filesystem::path(path).parent_path().string();
  return load(files.open(path), folder, options, files, diagnostics, statistics);
}

std::unique_ptr<RenderJob> loadSceneText(const std::string& text, const std::string& folder,
                                         const BuildOptions& options, SourceFiles& files,
                                         Diagnostics& diagnostics, Statistics& statistics) {
  return load(files.add("<text>", text), folder, options, files, diagnostics, statistics);
}

std::vector<const RegistryInfo*> allRegistries() {
  return {&integratorRegistry(),   &lightDistributionRegistry(),
          &samplerRegistry(),      &filmRegistry(),
          &filterRegistry(),       &cameraRegistry(),
          &shapeRegistry(),        &materialRegistry(),
          &floatTextureRegistry(), &spectrumTextureRegistry(),
          &lightRegistry(),        &areaLightRegistry(),
          &mediumRegistry()};
}

}  // namespace lampyris
