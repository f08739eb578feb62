// SPDX-License-Identifier: Apache-2.0
/// A render as a row of passes: its limits, its clock, and who is told what.
#pragma once

#include <chrono>

#include "base/integrator.h"
#include "core/rejections.h"
#include "integrators/pass_schedule.h"
#include "integrators/render_loop.h"

namespace lampyris {

class PassLoop {
 public:
  virtual ~PassLoop() = default;
  /// Passes until a limit is met or the render is cancelled. Returns the number of samples that all
  /// pixels have then.
  uint64_t run();

 protected:
  /// `target` and `timely` as for PassSchedule. What is `learned` between passes, if anything, goes
  /// into checkpoints. The clock starts now.
  PassLoop(RenderContext& context, uint64_t target, bool timely,
           const LearnedState* learned = nullptr)
      : context_(context),
        options_(context.options),
        target_(target),
        done_(options_.firstSample),
        learned_(learned),
        schedule_(options_, target, timely,
                  learned ? static_cast<double>(options_.firstSample) : 0) {}

  struct Pass {
    uint64_t samples = 0;    ///< that all pixels got; 0: it was cut short
    double meanSamples = 0;  ///< a pixel
  };
  /// Renders up to so many samples a pixel, ≥ 1, or stops as soon as cutShort().
  virtual Pass renderPass(uint64_t samples) = 0;
  struct Samples {
    double perPixel = 0;  ///< on average, earlier renders' included
    uint64_t made = 0;    ///< by this render, in all
  };
  virtual Samples samples() const = 0;

  /// The render's clock.
  double seconds() const { return secondsBetween(start_, Clock::now()) - paused_; }
  bool cancelled() const {
    return options_.cancel && options_.cancel->load(std::memory_order_relaxed);
  }
  bool cutShort() const { return cancelled() || (deadline_ > 0 && seconds() >= deadline_); }
  bool hasDeadline() const { return deadline_ > 0; }
  /// Tells who wants to know, not too often. From one thread at a time.
  void tellProgress();
  /// The statistics that all integrators have, at the end.
  void report(const RayCounts& rays) const;

  RenderContext& context_;
  const RenderOptions& options_;
  const uint64_t target_;  ///< 0: without limit
  uint64_t done_;          ///< samples that all pixels have

 private:
  using Clock = std::chrono::steady_clock;
  static double secondsBetween(Clock::time_point from, Clock::time_point to) {
    return std::chrono::duration<double>(to - from).count();
  }
  RenderProgress progress() const;
  void passDone();

  const LearnedState* const learned_;
  PassSchedule schedule_;
  const RejectionCounts rejectedBefore_ = rejectionCounts();
  const Clock::time_point start_ = Clock::now();
  double paused_ = 0;    ///< seconds for which the render's clock stood still
  double deadline_ = 0;  ///< of the pass; 0: none
  double noise_ = kInfinity;
  double lastProgress_ = 0;
};

}  // namespace lampyris
