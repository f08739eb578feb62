// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "guiding/guide.h"
#include "integrators/guiding_gain.h"
#include "integrators/render_loop.h"

namespace lampyris {

/// What a tile's paths leave for a guide to learn from, and the guide's place of work.
class GuidedMemory final : public EstimatorMemory {
 public:
  explicit GuidedMemory(std::unique_ptr<LocalGuide> local) : local(std::move(local)) {}

  /// A direction that a path took: its radiance is what the path finds from there on.
  struct Turn {
    GuideSample sample;
    Rgb throughput;  ///< after the turn
    Rgb before;      ///< radiance of the path until then, and what is not to be learned
  };
  /// Ends a path: turns its turns into samples.
  void finish(const Rgb& radiance);

  std::unique_ptr<LocalGuide> local;
  std::vector<Turn> turns;
  std::vector<GuideSample> samples;
  GuidingGain gain;
  double promised = 0;  ///< sum over all paths of VolumePath::promise
  uint64_t paths = 0;
  uint64_t lookups = 0, guided = 0, drawn = 0;
};

}  // namespace lampyris
