// SPDX-License-Identifier: Apache-2.0
/// Integrators: light transport from a scene to a film.
#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "base/camera.h"
#include "base/film.h"
#include "base/light_distribution.h"
#include "base/sampler.h"
#include "base/scene.h"
#include "core/statistics.h"

namespace lampyris {

/// A direction from which light is known to come: a cosine lobe around it, learned near a point.
struct LearnedDirection {
  Vec3 p{0}, direction{0};
  float exponent = 1, radiance = 0;  ///< of the lobe; at its peak
};

/// What an integrator has learned while it renders: a checkpoint must hold it.
class LearnedState {
 public:
  virtual std::string save() const = 0;
  /// For pictures of it; empty where it is not of that kind.
  virtual std::vector<LearnedDirection> directions() const { return {}; }

 protected:
  ~LearnedState() = default;
};

/// How far along a render is.
struct RenderProgress {
  uint64_t samplesDone = 0;    ///< that every pixel has
  double meanSamples = 0;      ///< a pixel, on average: some may be ahead by one
  uint64_t samplesTarget = 0;  ///< a pixel; 0: unknown (rendering for a time or to a noise)
  double fractionDone = 0;
  double seconds = 0;        ///< of rendering; time spent in onPass and onStop is left out
  uint64_t cameraPaths = 0;  ///< in all
  const LearnedState* learned = nullptr;  ///< null: nothing is
};

/// A state of the image that is wanted on the way: at a number of samples a pixel, or at a time.
struct RenderStop {
  uint64_t samples = 0;  ///< > 0: when every pixel has exactly so many
  double seconds = 0;    ///< else: when so much time has been spent rendering
};

/// A render ends at whichever of its limits comes first.
struct RenderOptions {
  uint64_t firstIndex = 0;   ///< of the samples: a part of a larger render begins later than at 0
  uint64_t firstSample = 0;  ///< the number of samples that all pixels have (after --resume)
  std::string learned;       ///< LearnedState::save() after these
  /// A pixel, the resumed ones included; 0: the sampler's number, or without limit where a time or
  /// a noise is given.
  uint64_t sampleCount = 0;
  /// > 0: until so much time has been spent rendering, but not before every pixel has a sample.
  double seconds = 0;
  double noise = 0;  ///< > 0: until Film::noise() is no more than this
  const std::atomic<bool>* cancel = nullptr;
  /// Called between tiles, from one thread at a time; may be empty.
  std::function<void(const RenderProgress&)> onProgress;
  /// Called after each pass, when every pixel has the same number of samples, or some one more
  /// where time has cut the pass short.
  std::function<void(const RenderProgress&)> onPass;
  std::vector<RenderStop> stops;  ///< in any order; those beyond the render's end are not met
  /// Called at each stop, with its index, after onPass.
  std::function<void(size_t, const RenderProgress&)> onStop;
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
  /// Renders into the film. Returns the number of samples that every pixel has.
  virtual uint64_t render(RenderContext& context) const = 0;
  virtual bool rendersMedia() const { return false; }
  /// False if a checkpoint holds too little for a render to go on from: the integrator has chains.
  virtual bool resumes() const { return true; }
  /// Not empty: why the merged parts of a render are not the bits of the one render, though as
  /// unbiased.
  virtual std::string_view partsDiffer() const { return {}; }
  /// Bytes that render() takes beside the film's samples, about: they are held against what there
  /// is before it begins.
  virtual double memory(const Film& film) const { return (void)film, 0; }
  /// False if the light image is all there is. Then nothing is known of a pixel alone: no samples
  /// to replay, no noise, no AOVs.
  virtual bool samplesPixels() const { return true; }
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
  uint64_t seed = 0;  ///< for numbers that come from no sampler
};

using IntegratorRegistry = Registry<Integrator, IntegratorContext>;

}  // namespace lampyris
