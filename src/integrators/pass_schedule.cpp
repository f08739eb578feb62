// SPDX-License-Identifier: Apache-2.0
#include "integrators/pass_schedule.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <tuple>

#include "core/math.h"

namespace lampyris {

namespace {

/// A pass takes about this long at most: between passes images and checkpoints are written.
constexpr double kPassSeconds = 4;
/// A pass is planned for this share of the time that is left: what a pass takes varies by as much
/// as a factor of two on a busy machine, and one of several samples is not cut short.
constexpr double kTimeShare = 0.5;
/// With fewer samples the estimate of the noise has not seen what is rare.
constexpr uint64_t kLeastNoiseSamples = 16;

constexpr double kNever = std::numeric_limits<double>::infinity();

/// n as a count of samples; 1 where it is less or no number.
uint64_t countOf(double n) { return n > 1 ? static_cast<uint64_t>(std::min(n, 1e15)) : 1; }

}  // namespace

PassSchedule::PassSchedule(const RenderOptions& options, uint64_t target, bool timely,
                           double rendered)
    : options_(options), target_(target), timely_(timely), rendered_(rendered) {
  for (size_t i = 0; i < options.stops.size(); ++i) pending_.push_back(i);
  std::stable_sort(pending_.begin(), pending_.end(), [&](size_t a, size_t b) {
    const RenderStop &x = options.stops[a], &y = options.stops[b];
    return std::tie(x.samples, x.seconds) < std::tie(y.samples, y.seconds);
  });
}

bool PassSchedule::finished(uint64_t done, double seconds, double noise) const {
  if (target_ > 0 && done >= target_) return true;
  if (done == 0) return false;
  if (options_.seconds > 0 && seconds >= options_.seconds) return true;
  return options_.noise > 0 && done >= kLeastNoiseSamples && noise <= options_.noise;
}

double PassSchedule::nextTime() const {
  double time = options_.seconds > 0 ? options_.seconds : kNever;
  for (const size_t i : pending_)
    if (options_.stops[i].samples == 0) time = std::min(time, options_.stops[i].seconds);
  return time;
}

uint64_t PassSchedule::samplesToStop(uint64_t done) const {
  uint64_t least = target_ > 0 ? target_ - done : std::numeric_limits<uint64_t>::max();
  for (const size_t i : pending_) {
    const uint64_t at = options_.stops[i].samples;
    if (at > done) least = std::min(least, at - done);
  }
  return least;
}

std::optional<PassSchedule::Pass> PassSchedule::next(uint64_t done, double seconds,
                                                     double noise) const {
  if (finished(done, seconds, noise)) return std::nullopt;
  Pass pass;
  pass.samples = std::min(countOf(rendered_), samplesToStop(done));
  const auto atMost = [&pass](double n) { pass.samples = std::min(pass.samples, countOf(n)); };
  // Noise falls with the square root of the number of samples.
  if (options_.noise > 0 && std::isfinite(noise))
    atMost(std::max(std::ceil(static_cast<double>(done) * (sqr(noise / options_.noise) - 1)),
                    static_cast<double>(kLeastNoiseSamples) - static_cast<double>(done)));
  const double time = nextTime();
  if (secondsPerSample_ > 0) {
    if (timely_) atMost(kPassSeconds / secondsPerSample_);
    atMost(kTimeShare * (time - seconds) / secondsPerSample_);
  }
  if (pass.samples == 1 && done > 0 && time < kNever) pass.deadline = time;
  return pass;
}

void PassSchedule::passDone(double samples, double seconds) {
  rendered_ += samples;
  // A small piece of an image says little about all of it.
  if (samples >= 0.1) secondsPerSample_ = seconds / samples;
}

std::vector<size_t> PassSchedule::takeStops(uint64_t done, double seconds) {
  std::vector<size_t> met;
  for (const size_t i : pending_) {
    const RenderStop& stop = options_.stops[i];
    if (stop.samples > 0 ? stop.samples == done : done > 0 && stop.seconds <= seconds)
      met.push_back(i);
  }
  std::erase_if(pending_,
                [&](size_t i) { return std::find(met.begin(), met.end(), i) != met.end(); });
  return met;
}

double PassSchedule::fraction(double samples, double seconds, double noise) const {
  double f = 0;
  if (target_ > 0) f = samples / static_cast<double>(target_);
  if (options_.seconds > 0) f = std::max(f, seconds / options_.seconds);
  if (options_.noise > 0 && noise > 0) f = std::max(f, sqr(options_.noise / noise));
  return std::min(f, 1.);
}

}  // namespace lampyris
