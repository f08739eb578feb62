// SPDX-License-Identifier: Apache-2.0
/// How many samples each pass of a render takes, so that it meets its limits and its stops.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "base/integrator.h"

namespace lampyris {

/// Passes double what has been rendered, so that first images come early and later ones cost no
/// synchronisation, within what the limits and the next stop leave. Reads no clock.
class PassSchedule {
 public:
  /// `target`: samples a pixel, 0: without limit. Copies nothing: `options` must live as long.
  /// `timely` false: passes are not kept short, so that without a limit of time their sizes do not
  /// depend on time. `rendered`: samples a pixel of an earlier run that count for what doubles.
  PassSchedule(const RenderOptions& options, uint64_t target, bool timely = true,
               double rendered = 0);

  struct Pass {
    uint64_t samples = 1;
    /// > 0: the pass ends at this time of the render's clock, unfinished if need be. Only passes of
    /// one sample, so that no pixel is ahead of another by more.
    double deadline = 0;
  };
  /// After `done` samples of every pixel, at `seconds` of the render's clock, with the estimated
  /// relative error `noise` (read where RenderOptions::noise asks for it). None: the render is
  /// done.
  std::optional<Pass> next(uint64_t done, double seconds, double noise) const;
  /// A pass has rendered so many samples a pixel, on average, in so many seconds.
  void passDone(double samples, double seconds);
  /// Takes the stops that are met; their indices, earliest first.
  std::vector<size_t> takeStops(uint64_t done, double seconds);
  /// How much of the render is done, by the limit that is nearest.
  double fraction(double samples, double seconds, double noise) const;

 private:
  bool finished(uint64_t done, double seconds, double noise) const;
  double nextTime() const;
  uint64_t samplesToStop(uint64_t done) const;

  const RenderOptions& options_;
  const uint64_t target_;
  const bool timely_;
  std::vector<size_t> pending_;  ///< stops not met yet
  double rendered_;
  double secondsPerSample_ = 0;
};

}  // namespace lampyris
