// SPDX-License-Identifier: Apache-2.0
#include "integrators/render_loop.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <mutex>
#include <numeric>

#include "core/parallel.h"
#include "integrators/bad_samples.h"
#include "integrators/pass_schedule.h"

namespace lampyris {

namespace {

constexpr double kProgressInterval = 0.1;
constexpr int kObservedTileSize = 8;

using Clock = std::chrono::steady_clock;

double secondsBetween(Clock::time_point from, Clock::time_point to) {
  return std::chrono::duration<double>(to - from).count();
}

class PassRenderer {
 public:
  PassRenderer(RenderContext& context, const PixelBounds& pixels,
               const RadianceEstimator& estimator, PassObserver* observer)
      : context_(context),
        options_(context.options),
        pixels_(pixels),
        estimator_(estimator),
        observer_(observer),
        target_(options_.sampleCount > 0 ? options_.sampleCount
                : options_.seconds > 0 || options_.noise > 0
                    ? 0
                    : static_cast<uint64_t>(context.sampler.samplesPerPixel())),
        schedule_(options_, target_, observer == nullptr),
        aovs_(context.film.aovs()),
        done_(options_.firstSample),
        // As in pbrt-v3: the footprint of one of several samples is smaller than the pixel.
        differentialScale_(
            1 / std::sqrt(static_cast<float>(std::max(1, context.sampler.samplesPerPixel())))) {
    for (const auto& m : context.scene.materials)
      if (m->wantsDifferentials()) differentials_ = true;
    if (observer_) {
      tileSize_ = kObservedTileSize;
      return;
    }
    // Small images are cut finer so that all threads have work to the end.
    const int64_t wanted = 8LL * threadCount();
    while (tileSize_ > 2 && tilesAcross() * tilesDown() < wanted) tileSize_ /= 2;
  }

  uint64_t run();

 private:
  int64_t tilesAcross() const { return (pixels_.size().x + tileSize_ - 1) / tileSize_; }
  int64_t tilesDown() const { return (pixels_.size().y + tileSize_ - 1) / tileSize_; }
  double perPixel(uint64_t paths) const {
    return static_cast<double>(paths) / static_cast<double>(pixels_.area());
  }
  /// The render's clock.
  double seconds() const { return secondsBetween(start_, Clock::now()) - paused_; }
  bool cancelled() const {
    return options_.cancel && options_.cancel->load(std::memory_order_relaxed);
  }
  bool cutShort() const { return cancelled() || (deadline_ > 0 && seconds() >= deadline_); }
  void renderPass(uint64_t samples);
  void passDone();
  void renderTile(int64_t tile, uint64_t end);
  void renderPixel(SampleAddress address, uint64_t end, RenderState& state, BadSamples& bad) const;
  void renderSample(const SampleAddress& address, RenderState& state, BadSamples& bad) const;
  RenderProgress progress() const;
  void tileDone(uint64_t paths, bool whole, const RenderState& state, const BadSamples& bad);
  void report(double seconds);

  RenderContext& context_;
  const RenderOptions& options_;
  const PixelBounds pixels_;
  const RadianceEstimator& estimator_;
  PassObserver* const observer_;
  const uint64_t target_;  ///< 0: without limit
  PassSchedule schedule_;
  const AovSet aovs_;
  uint64_t done_;
  const float differentialScale_;
  bool differentials_ = false;
  int tileSize_ = 16;
  const Clock::time_point start_ = Clock::now();
  double paused_ = 0;    ///< seconds for which the render's clock stood still
  double deadline_ = 0;  ///< of the pass; 0: none
  double noise_ = kInfinity;
  uint64_t earlierPaths_ = 0;  ///< that the film had of these pixels at the start

  std::mutex mutex_;  ///< guards what follows, and the progress callback
  uint64_t paths_ = 0;
  int64_t wholeTiles_ = 0;  ///< of the pass, that were not cut short
  double lastProgress_ = 0;
  RayCounts rays_;
  DirectCounts direct_;
  BadSamples bad_;
};

uint64_t PassRenderer::run() {
  for (int y = pixels_.min.y; y < pixels_.max.y; ++y)
    for (int x = pixels_.min.x; x < pixels_.max.x; ++x)
      earlierPaths_ += context_.film.sampleCount({x, y});
  if (options_.noise > 0) noise_ = context_.film.noise();
  while (!cancelled()) {
    const auto pass = schedule_.next(done_, seconds(), noise_);
    if (!pass) break;
    deadline_ = pass->deadline;
    renderPass(estimator_.beginPass(done_, pass->samples));
    if (!cancelled()) passDone();
  }
  report(seconds());
  return done_;
}

/// A number without a common divisor with `count`, about the golden section of it.
int64_t strideFor(int64_t count) {
  auto stride = static_cast<int64_t>(0.618 * static_cast<double>(count));
  while (std::gcd(stride, count) != 1) ++stride;
  return stride;
}

void PassRenderer::renderPass(uint64_t samples) {
  const int64_t tiles = tilesAcross() * tilesDown();
  // A pass that may be cut short takes the tiles of the whole image evenly.
  const int64_t stride = deadline_ > 0 ? strideFor(tiles) : 1;
  const uint64_t end = done_ + samples;
  const double before = seconds();
  const uint64_t pathsBefore = paths_;
  wholeTiles_ = 0;
  if (observer_) observer_->beginPass({samples, static_cast<size_t>(tiles), end == target_});
  parallelFor(static_cast<size_t>(tiles), 1, [&](size_t first, size_t last) {
    for (size_t t = first; t < last && !cutShort(); ++t)
      renderTile(static_cast<int64_t>(t) * stride % tiles, end);
  });
  schedule_.passDone(perPixel(paths_ - pathsBefore), seconds() - before);
  if (wholeTiles_ != tiles) return;
  done_ = end;
  if (observer_) observer_->endPass();
}

/// Calls who looks at the image, while the render's clock stands still.
void PassRenderer::passDone() {
  const double now = seconds();
  const Clock::time_point start = Clock::now();
  if (options_.noise > 0) noise_ = context_.film.noise();
  const RenderProgress p = progress();
  if (options_.onPass) options_.onPass(p);
  for (const size_t stop : schedule_.takeStops(done_, now))
    if (options_.onStop) options_.onStop(stop, p);
  paused_ += secondsBetween(start, Clock::now());
}

void PassRenderer::renderTile(int64_t tile, uint64_t end) {
  const Int2 corner = pixels_.min + Int2(static_cast<int>(tile % tilesAcross()),
                                         static_cast<int>(tile / tilesAcross())) *
                                        tileSize_;
  const PixelBounds area = intersect(pixels_, {corner, corner + Int2(tileSize_)});
  RenderState state;
  state.memory = estimator_.makeMemory();
  BadSamples bad;
  uint64_t paths = 0;
  bool whole = true;
  for (int y = area.min.y; y < area.max.y && whole; ++y) {
    for (int x = area.min.x; x < area.max.x; ++x) {
      const SampleAddress first{{x, y}, context_.film.sampleCount({x, y})};
      if (first.index >= end) continue;
      whole = !cutShort();
      if (!whole) break;
      renderPixel(first, end, state, bad);
      paths += end - first.index;
    }
  }
  if (observer_) observer_->tileDone(static_cast<size_t>(tile), state);
  tileDone(paths, whole, state, bad);
}

void PassRenderer::renderPixel(SampleAddress address, uint64_t end, RenderState& state,
                               BadSamples& bad) const {
  if (aovs_.empty()) {
    for (; address.index < end; ++address.index) renderSample(address, state, bad);
    return;
  }
  const bool timed = aovs_.has(Aov::Time);
  for (; address.index < end; ++address.index) {
    AovRecord record;
    state.aov = &record;
    const uint64_t rays = state.rays.closest;
    const Clock::time_point before = timed ? Clock::now() : Clock::time_point();
    renderSample(address, state, bad);
    if (timed) record.seconds = secondsBetween(before, Clock::now());
    record.segments = state.rays.closest - rays;
    context_.film.addAovs(address.pixel, record);
  }
  state.aov = nullptr;
}

void PassRenderer::renderSample(const SampleAddress& address, RenderState& state,
                                BadSamples& bad) const {
  SampleStream stream(context_.sampler, address);
  const FilterSample filtered = context_.film.filter().sample(stream.next2D());
  CameraSample sample;
  sample.film = Vec2(address.pixel) + 0.5f + filtered.offset;
  sample.lens = stream.next2D();
  sample.time = stream.next1D();
  CameraRay camera = context_.camera.generate(sample);
  Rgb radiance;
  if (camera.weight > 0) {
    if (differentials_) {
      const Ray& r = camera.ray;
      RayDifferential& d = camera.differential;
      d.xOrigin = r.o + (d.xOrigin - r.o) * differentialScale_;
      d.yOrigin = r.o + (d.yOrigin - r.o) * differentialScale_;
      d.xDirection = r.d + (d.xDirection - r.d) * differentialScale_;
      d.yDirection = r.d + (d.yDirection - r.d) * differentialScale_;
    }
    if (state.aov) state.aov->cameraPoint = camera.ray.o;
    stream.setDimension(kFirstPathDimension);
    radiance = estimator_.radiance(camera, stream, state) * camera.weight;
  }
  if (!context_.film.addSample(address.pixel, radiance, filtered.weight))
    bad.add(address, radiance);
}

RenderProgress PassRenderer::progress() const {
  RenderProgress p;
  p.samplesDone = done_;
  p.meanSamples = perPixel(earlierPaths_ + paths_);
  p.samplesTarget = target_;
  p.seconds = seconds();
  p.cameraPaths = paths_;
  p.fractionDone = schedule_.fraction(p.meanSamples, p.seconds, noise_);
  return p;
}

void PassRenderer::tileDone(uint64_t paths, bool whole, const RenderState& state,
                            const BadSamples& bad) {
  const std::lock_guard lock(mutex_);
  paths_ += paths;
  wholeTiles_ += whole ? 1 : 0;
  rays_ += state.rays;
  direct_ += state.direct;
  if (!bad.empty()) bad_.merge(bad);
  if (!options_.onProgress) return;
  const double now = seconds();
  if (now - lastProgress_ < kProgressInterval) return;
  lastProgress_ = now;
  options_.onProgress(progress());
}

void PassRenderer::report(double seconds) {
  Statistics& s = context_.statistics;
  const auto total = static_cast<double>(rays_.closest + rays_.shadow);
  s.set("render", "samples per pixel", progress().meanSamples);
  s.set("render", "seconds", seconds);
  s.set("render", "camera paths", static_cast<double>(paths_));
  s.set("render", "camera paths per second",
        seconds > 0 ? static_cast<double>(paths_) / seconds : 0);
  s.set("render", "rays", static_cast<double>(rays_.closest));
  s.set("render", "shadow rays", static_cast<double>(rays_.shadow));
  s.set("render", "rays per second", seconds > 0 ? total / seconds : 0);
  direct_.report(s);
  bad_.report(s);
}

}  // namespace

PixelBounds renderedPixels(const Film& film, const std::vector<int>& pixelBounds,
                           SourceLocation location) {
  if (pixelBounds.empty()) return film.bounds();
  if (pixelBounds.size() != 4)
    throw SceneError(location,
                     fmt::format("parameter \"pixelbounds\": expected x0 x1 y0 y1, got {} "
                                 "value{}",
                                 pixelBounds.size(), pixelBounds.size() == 1 ? "" : "s"));
  const PixelBounds both = intersect(
      film.bounds(), {{pixelBounds[0], pixelBounds[2]}, {pixelBounds[1], pixelBounds[3]}});
  if (both.area() == 0)
    throw SceneError(location,
                     "parameter \"pixelbounds\" (x0 x1 y0 y1) has no pixel of the film in it");
  return both;
}

uint64_t renderPasses(RenderContext& context, const PixelBounds& pixels,
                      const RadianceEstimator& estimator, PassObserver* observer) {
  return PassRenderer(context, pixels, estimator, observer).run();
}

}  // namespace lampyris
