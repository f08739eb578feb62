// SPDX-License-Identifier: Apache-2.0
/// What all parts of the builder share.
#pragma once

#include <functional>
#include <mutex>
#include <string>
#include <vector>

#include "core/animated_transform.h"
#include "core/image.h"
#include "scene/builder.h"
#include "scene/description.h"
#include "scene/overrides.h"
#include "scene/spectrum_files.h"

namespace lampyris {

struct BuildState {
  BuildState(const Description& description, const BuildOptions& options, const std::string& folder,
             SourceFiles& files, Diagnostics& diagnostics, Statistics& statistics, RenderJob& job);

  const Description& description;
  const BuildOptions& options;
  Diagnostics& diagnostics;
  Statistics& statistics;
  RenderJob& job;
  std::function<std::string(const std::string&)> resolvePath;
  Overrides overrides;
  ImageCache images;
  SpectrumFiles spectra;

  BuildContext context(SourceLocation where) const { return {diagnostics, resolvePath, where}; }
  /// The transform of what cannot move: at the start; warns where it would move.
  const Transform& transform(uint32_t index, SourceLocation where) const;
  bool isAnimated(uint32_t index) const { return description.transforms[index].isAnimated(); }
  AnimatedTransform motion(uint32_t index) const;

 private:
  std::mutex filesMutex_;
};

/// body(i) for i in [0, count) in parallel. Of several exceptions the one of the lowest i is
/// thrown, so that a scene's message does not depend on threads.
void parallelForEach(size_t count, size_t grain, const std::function<void(size_t)>& body);

/// Film, camera and sampler.
void buildView(BuildState& state);
/// The integrator is chosen, and its parameters checked, before the scene is built, for that may
/// take long; it is created after.
struct IntegratorChoice {
  const IntegratorRegistry::Entry* plugin;
  ChangedParameters parameters;
};
IntegratorChoice chooseIntegrator(BuildState& state);
void buildIntegrator(BuildState& state, const IntegratorChoice& choice);
/// Shapes, their materials, lights, and everything else in RenderJob::scene.
void buildWorld(BuildState& state);

}  // namespace lampyris
