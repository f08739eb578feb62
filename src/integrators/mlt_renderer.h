// SPDX-License-Identifier: Apache-2.0
/// Markov chains over paths, for Metropolis light transport.
#pragma once

#include <mutex>
#include <vector>

#include "integrators/bad_samples.h"
#include "integrators/mlt_paths.h"
#include "integrators/pass_loop.h"
#include "integrators/primary_samples.h"

namespace lampyris {

struct MltSettings {
  int maxDepth = 5;
  uint64_t bootstrapSamples = 100000;  ///< for each number of bounces
  size_t chains = 1000;
  uint64_t mutationsPerPixel = 100;  ///< where the render's options give no limit
  float largeStepProbability = 0.3f;
  float sigma = 0.01f;
  uint64_t seed = 0;
};

/// A sample of a pixel is a mutation here. The image has the right mean after any number of them.
class MltRenderer final : public PassLoop {
 public:
  MltRenderer(RenderContext& context, const LightDistribution* distribution,
              const MltSettings& settings);

  /// Of the bootstrap and of chains as long as they can be, in bytes.
  static double memory(const MltSettings& settings);
  /// Returns the number of mutations per pixel.
  uint64_t render();

 private:
  /// A path, and the density by which it is drawn.
  struct State {
    Splat splat;
    double brightness = 0;
  };
  struct Chain {
    int depth;
    PrimarySamples numbers;
    State state;
    double weight = 0;       ///< of the state, not yet on the film
    uint64_t mutations = 0;  ///< so far
  };
  /// What a thread adds up.
  struct Work {
    RayCounts rays;
    BadSamples bad;
    uint64_t mutations = 0, accepted = 0;
  };

  Pass renderPass(uint64_t samples) override;
  Samples samples() const override;
  /// Those of a render's parts are numbered through.
  uint64_t chainNumber(size_t chain) const {
    return options_.firstIndex * settings_.chains + chain;
  }
  void bootstrap();
  std::vector<double> bootstrapBrightness();
  void startChain(size_t start);
  State evaluate(const Chain& chain, Work& work) const;
  void advance(size_t number, uint64_t end);
  void mutate(Chain& chain, uint64_t seed, Work& work) const;
  void addToFilm(const State& state, double weight, Work& work) const;
  void add(const Work& work);

  const MltSettings settings_;
  const MltPaths paths_;
  const uint64_t pixels_;
  double mean_ = 0;  ///< brightness, over all primary samples and summed over depths
  std::vector<Chain> chains_;

  std::mutex mutex_;  ///< guards what follows
  Work total_;
};

}  // namespace lampyris
