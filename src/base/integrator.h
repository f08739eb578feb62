// SPDX-License-Identifier: Apache-2.0
/// Integrators: light transport from a scene to a film.
#pragma once

#include <atomic>
#include <functional>

#include "base/camera.h"
#include "base/film.h"
#include "base/light_distribution.h"
#include "base/sampler.h"
#include "base/scene.h"
#include "core/statistics.h"

namespace lampyris {

/// How far along a render is.
struct RenderProgress {
  uint64_t samplesDone = 0;    ///< a pixel, all passes
  uint64_t samplesTarget = 0;  ///< a pixel; 0: unknown (rendering for a given time)
  double fractionDone = 0;
  double seconds = 0;
  uint64_t cameraPaths = 0;  ///< in all
};

struct RenderOptions {
  uint64_t firstSample = 0;  ///< index to start at (after --resume)
  uint64_t sampleCount = 0;  ///< a pixel, the resumed ones included
  double seconds = 0;        ///< > 0: until this time has passed, whatever sampleCount says
  const std::atomic<bool>* cancel = nullptr;
  /// Called between tiles, from one thread at a time; may be empty.
  std::function<void(const RenderProgress&)> onProgress;
  /// Called after each pass, when every pixel has the same number of samples.
  std::function<void(const RenderProgress&)> onPass;
};

/// What an integrator works with.
struct RenderContext {
  const Scene& scene;
  const Camera& camera;
  const Sampler& sampler;
  Film& film;
  RenderOptions options;
  Statistics& statistics;
};

class Integrator {
 public:
  virtual ~Integrator() = default;
  /// Renders into the film. Returns the number of samples a pixel that all pixels have.
  virtual uint64_t render(RenderContext& context) const = 0;
};

struct IntegratorContext : BuildContext {
  const Scene& scene;
  using Settings = std::vector<std::pair<std::string, std::string>>;
  /// Makes the light distribution that the integrator's parameters name; `name` empty: the default.
  /// `settings` count instead of parameters of the same name.
  std::unique_ptr<LightDistribution> lightDistribution(const std::string& name,
                                                       const Settings& settings = {}) const {
    return makeLightDistribution(name, settings);
  }
  std::function<std::unique_ptr<LightDistribution>(const std::string&, const Settings&)>
      makeLightDistribution;
};

using IntegratorRegistry = Registry<Integrator, IntegratorContext>;

}  // namespace lampyris
