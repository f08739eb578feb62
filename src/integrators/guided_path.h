// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <chrono>
#include <mutex>

#include "integrators/volume_path.h"

namespace lampyris {

/// Feeds a guide with the samples of each pass, in the order of the tiles.
class GuideTrainer final : public PassObserver {
 public:
  /// That a pass leaves to be learned from, about and at most: bounds memory and time.
  static constexpr double kSamplesPerPass = 1 << 18;

  /// `guidance` is what the paths see; its guide is `guide`. `pixels`: how many are rendered.
  GuideTrainer(Guide& guide, Guidance& guidance, int64_t pixels, int passesBeforeRetiring)
      : guide_(guide),
        guidance_(guidance),
        pixels_(static_cast<double>(pixels)),
        passesBeforeRetiring_(passesBeforeRetiring) {}

  void beginPass(const Pass& pass) override;
  void tileDone(size_t tile, RenderState& state) override;
  void endPass() override;
  void report(Statistics& statistics) const;
  std::string save() const override;
  std::vector<LearnedDirection> directions() const override { return guide_.directions(); }
  /// False: the bytes are of no such state.
  bool restore(std::string_view bytes);

 private:
  Guide& guide_;
  Guidance& guidance_;
  const double pixels_;
  const int passesBeforeRetiring_;
  Pass pass_;
  /// What the paths of a tile have left.
  struct Tile {
    std::vector<GuideSample> samples;
    GuidingGain gain;
    double promised = 0;
    uint64_t paths = 0;
  };
  std::vector<Tile> tiles_;    ///< of the pass
  GuidingGain gain_;           ///< of all passes, early ones less
  double samplesPerPath_ = 0;  ///< learned from, of a path that is learned from
  int passes_ = 0;
  bool retired_ = false;  ///< the guide does not pay: neither used nor taught any more
  double seconds_ = 0;

  std::mutex mutex_;  ///< guards the counts
  uint64_t lookups_ = 0, guided_ = 0, drawn_ = 0;
};

}  // namespace lampyris
