// SPDX-License-Identifier: Apache-2.0
/// Russian roulette of paths with or without a guide.
#pragma once

#include "integrators/volume_path_state.h"

namespace lampyris {

/// Each draw divides the throughput by its chance and keeps path.odds. False: the path ends.
class GuidedRoulette {
 public:
  explicit GuidedRoulette(float threshold) : threshold_(threshold) {}

  /// At a new vertex, of which a guide may know more later: with the probabilities of pbrt-v3
  /// unless a guide has promised something.
  bool survives(VolumePath& path) const { return path.promise > 0 || survivesByThroughput(path); }
  /// Where no guide knows anything.
  bool survivesByThroughput(VolumePath& path) const {
    return path.bounces <= kFirstBounce || drawByThroughput(path);
  }
  /// By the radiance that is still to come, `scattered` × throughput as the guide expects it, in
  /// relation to what was to come at the first vertex with a guide (Vorba and Křivánek 2016,
  /// "Adjoint-Driven Russian Roulette and Splitting in Light Transport Simulation", without the
  /// splitting).
  bool survivesByPromise(VolumePath& path, float scattered) const;

 private:
  static constexpr int kFirstBounce = 4;
  bool drawByThroughput(VolumePath& path) const;
  float end(const VolumePath& path, float throughput) const;
  void goOn(VolumePath& path, float chance) const;

  float threshold_;
};

}  // namespace lampyris
