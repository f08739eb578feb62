// SPDX-License-Identifier: Apache-2.0
#include "integrators/pass_loop.h"

namespace lampyris {

namespace {

constexpr double kProgressInterval = 0.1;

}  // namespace

uint64_t PassLoop::run() {
  if (options_.noise > 0) noise_ = context_.film.noise();
  while (!cancelled()) {
    const auto next = schedule_.next(done_, seconds(), noise_);
    if (!next) break;
    deadline_ = next->deadline;
    const double before = seconds();
    const Pass pass = renderPass(next->samples);
    schedule_.passDone(pass.meanSamples, seconds() - before);
    done_ += pass.samples;
    if (!cancelled()) passDone();
  }
  return done_;
}

/// Calls who looks at the image, while the render's clock stands still.
void PassLoop::passDone() {
  const double now = seconds();
  const Clock::time_point start = Clock::now();
  if (options_.noise > 0) noise_ = context_.film.noise();
  const RenderProgress p = progress();
  if (options_.onPass) options_.onPass(p);
  for (const size_t stop : schedule_.takeStops(done_, now))
    if (options_.onStop) options_.onStop(stop, p);
  paused_ += secondsBetween(start, Clock::now());
}

RenderProgress PassLoop::progress() const {
  const Samples s = samples();
  RenderProgress p;
  p.samplesDone = done_;
  p.meanSamples = s.perPixel;
  p.samplesTarget = target_;
  p.seconds = seconds();
  p.cameraPaths = s.made;
  p.learned = learned_;
  p.fractionDone = schedule_.fraction(p.meanSamples, p.seconds, noise_);
  return p;
}

void PassLoop::tellProgress() {
  if (!options_.onProgress) return;
  const double now = seconds();
  if (now - lastProgress_ < kProgressInterval) return;
  lastProgress_ = now;
  options_.onProgress(progress());
}

void PassLoop::report(const RayCounts& rays) const {
  Statistics& s = context_.statistics;
  const RenderProgress p = progress();
  const auto paths = static_cast<double>(p.cameraPaths),
             rayCount = static_cast<double>(rays.closest),
             shadowCount = static_cast<double>(rays.shadow);
  const auto rate = [&p](double count) { return p.seconds > 0 ? count / p.seconds : 0; };
  s.set("render", "samples per pixel", p.meanSamples);
  s.set("render", "seconds", p.seconds);
  s.set("render", "camera paths", paths);
  s.set("render", "camera paths per second", rate(paths));
  s.set("render", "rays", rayCount);
  s.set("render", "shadow rays", shadowCount);
  s.set("render", "rays per second", rate(rayCount + shadowCount));
  reportRejections(s, rejectedBefore_);
  if (rays.tracking.rays == 0) return;
  const auto tracked = static_cast<double>(rays.tracking.rays);
  s.set("media", "tracked rays", tracked);
  s.set("media", "steps per ray", static_cast<double>(rays.tracking.steps) / tracked);
}

}  // namespace lampyris
