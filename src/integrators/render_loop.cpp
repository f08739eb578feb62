// SPDX-License-Identifier: Apache-2.0
#include "integrators/render_loop.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <mutex>

#include "core/parallel.h"

namespace lampyris {

namespace {

/// A pass takes about this long at most: between passes images and checkpoints are written.
constexpr double kPassSeconds = 4;
constexpr double kProgressInterval = 0.1;
constexpr size_t kReportedBadSamples = 10;

/// Samples whose radiance is no radiance: how many of which kind, and the first of them.
class BadSamples {
 public:
  void add(const SampleAddress& address, const Rgb& radiance) {
    const bool nan = std::isnan(radiance.r) || std::isnan(radiance.g) || std::isnan(radiance.b);
    ++(nan ? nan_ : radiance.isFinite() ? negative_ : infinite_);
    if (first_.size() < kReportedBadSamples) first_.push_back(address);
  }
  bool empty() const { return nan_ + infinite_ + negative_ == 0; }

  void merge(const BadSamples& other) {
    nan_ += other.nan_;
    infinite_ += other.infinite_;
    negative_ += other.negative_;
    first_.insert(first_.end(), other.first_.begin(), other.first_.end());
    // In an order that does not depend on which tile was done first.
    std::sort(first_.begin(), first_.end(), [](const SampleAddress& a, const SampleAddress& b) {
      return std::tie(a.index, a.pixel.y, a.pixel.x) < std::tie(b.index, b.pixel.y, b.pixel.x);
    });
    if (first_.size() > kReportedBadSamples) first_.resize(kReportedBadSamples);
  }

  void report(Statistics& statistics) const {
    const auto count = [](uint64_t n) { return static_cast<double>(n); };
    statistics.add("bad samples", "not a number", count(nan_));
    statistics.add("bad samples", "infinite", count(infinite_));
    statistics.add("bad samples", "negative", count(negative_));
    if (first_.empty()) return;
    std::string list;
    for (const SampleAddress& a : first_)
      list += fmt::format("{}{},{} #{}", list.empty() ? "" : "; ", a.pixel.x, a.pixel.y, a.index);
    statistics.set("bad samples", "pixel x,y #sample", list);
  }

 private:
  uint64_t nan_ = 0, infinite_ = 0, negative_ = 0;
  std::vector<SampleAddress> first_;
};

class PassRenderer {
 public:
  PassRenderer(RenderContext& context, const PixelBounds& pixels,
               const RadianceEstimator& estimator)
      : context_(context),
        options_(context.options),
        pixels_(pixels),
        estimator_(estimator),
        target_(options_.seconds > 0 ? 0
                : options_.sampleCount > 0
                    ? options_.sampleCount
                    : static_cast<uint64_t>(context.sampler.samplesPerPixel())),
        done_(options_.firstSample),
        // As in pbrt-v3: the footprint of one of several samples is smaller than the pixel.
        differentialScale_(
            1 / std::sqrt(static_cast<float>(std::max(1, context.sampler.samplesPerPixel())))) {
    for (const auto& m : context.scene.materials)
      if (m->wantsDifferentials()) differentials_ = true;
    // Small images are cut finer so that all threads have work to the end.
    const int64_t wanted = 8LL * threadCount();
    while (tileSize_ > 2 && tilesAcross() * tilesDown() < wanted) tileSize_ /= 2;
  }

  uint64_t run();

 private:
  int64_t tilesAcross() const { return (pixels_.size().x + tileSize_ - 1) / tileSize_; }
  int64_t tilesDown() const { return (pixels_.size().y + tileSize_ - 1) / tileSize_; }
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }
  bool cancelled() const {
    return options_.cancel && options_.cancel->load(std::memory_order_relaxed);
  }
  uint64_t nextPassSize(uint64_t rendered, double secondsPerSample) const;
  void renderTile(int64_t tile, uint64_t end);
  void renderSample(const SampleAddress& address, RenderState& state, BadSamples& bad) const;
  RenderProgress progress(double tilesDone) const;
  void tileDone(uint64_t paths, const RenderState& state, const BadSamples& bad);
  void report(double seconds);

  RenderContext& context_;
  const RenderOptions& options_;
  const PixelBounds pixels_;
  const RadianceEstimator& estimator_;
  const uint64_t target_;  ///< 0: by time
  uint64_t done_;
  const float differentialScale_;
  bool differentials_ = false;
  int tileSize_ = 16;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();

  std::mutex mutex_;  ///< guards what follows, and the progress callback
  uint64_t paths_ = 0;
  int64_t tilesDone_ = 0;
  uint64_t passSize_ = 0;
  double lastProgress_ = 0;
  RayCounts rays_;
  BadSamples bad_;
};

/// Passes double what has been rendered, so that first images come early and later ones cost no
/// synchronisation, within what the target and the time leave. 0: done.
uint64_t PassRenderer::nextPassSize(uint64_t rendered, double secondsPerSample) const {
  uint64_t size = std::max<uint64_t>(rendered, 1);
  if (rendered > 0 && secondsPerSample > 0) {
    const auto within = [&](double time) {
      return static_cast<uint64_t>(std::min(time / secondsPerSample, 1e15));
    };
    size = std::min(size, std::max<uint64_t>(1, within(kPassSeconds)));
    if (options_.seconds > 0) {
      // Half a sample over the limit is as near as half a sample short of it.
      const double left = options_.seconds - seconds();
      if (left < 0.5 * secondsPerSample) return 0;
      size = std::min(size, std::max<uint64_t>(1, within(left)));
    }
  }
  if (target_ > 0) size = std::min(size, target_ - std::min(target_, done_));
  return size;
}

uint64_t PassRenderer::run() {
  const auto tiles = static_cast<size_t>(tilesAcross() * tilesDown());
  uint64_t rendered = 0;
  double secondsPerSample = 0;
  while (!cancelled()) {
    passSize_ = nextPassSize(rendered, secondsPerSample);
    if (passSize_ == 0) break;
    const double before = seconds();
    const uint64_t end = done_ + passSize_;
    tilesDone_ = 0;
    parallelFor(tiles, 1, [&](size_t first, size_t last) {
      for (size_t t = first; t < last && !cancelled(); ++t)
        renderTile(static_cast<int64_t>(t), end);
    });
    if (cancelled()) break;
    secondsPerSample = (seconds() - before) / static_cast<double>(passSize_);
    rendered += passSize_;
    done_ = end;
    passSize_ = 0;
    if (options_.onPass) options_.onPass(progress(0));
  }
  report(seconds());
  return done_;
}

void PassRenderer::renderTile(int64_t tile, uint64_t end) {
  const Int2 corner = pixels_.min + Int2(static_cast<int>(tile % tilesAcross()),
                                         static_cast<int>(tile / tilesAcross())) *
                                        tileSize_;
  const PixelBounds area = intersect(pixels_, {corner, corner + Int2(tileSize_)});
  RenderState state;
  BadSamples bad;
  uint64_t paths = 0;
  for (int y = area.min.y; y < area.max.y; ++y) {
    for (int x = area.min.x; x < area.max.x && !cancelled(); ++x) {
      SampleAddress address{{x, y}, context_.film.sampleCount({x, y})};
      for (; address.index < end; ++address.index, ++paths) renderSample(address, state, bad);
    }
  }
  tileDone(paths, state, bad);
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
    stream.setDimension(kFirstPathDimension);
    radiance = estimator_.radiance(camera, stream, state) * camera.weight;
  }
  if (!context_.film.addSample(address.pixel, radiance, filtered.weight))
    bad.add(address, radiance);
}

RenderProgress PassRenderer::progress(double tilesDone) const {
  RenderProgress p;
  p.samplesDone = done_;
  p.samplesTarget = target_;
  p.seconds = seconds();
  p.cameraPaths = paths_;
  if (target_ == 0) {
    p.fractionDone = std::min(1., p.seconds / options_.seconds);
  } else {
    const double inPass = tilesDone / static_cast<double>(tilesAcross() * tilesDown()) *
                          static_cast<double>(passSize_);
    p.fractionDone =
        std::min(1., (static_cast<double>(done_) + inPass) / static_cast<double>(target_));
  }
  return p;
}

void PassRenderer::tileDone(uint64_t paths, const RenderState& state, const BadSamples& bad) {
  const std::lock_guard lock(mutex_);
  paths_ += paths;
  ++tilesDone_;
  rays_ += state.rays;
  if (!bad.empty()) bad_.merge(bad);
  if (!options_.onProgress) return;
  const double now = seconds();
  if (now - lastProgress_ < kProgressInterval) return;
  lastProgress_ = now;
  options_.onProgress(progress(static_cast<double>(tilesDone_)));
}

void PassRenderer::report(double seconds) {
  Statistics& s = context_.statistics;
  const auto total = static_cast<double>(rays_.closest + rays_.shadow);
  s.set("render", "samples per pixel", static_cast<double>(done_));
  s.set("render", "seconds", seconds);
  s.set("render", "camera paths", static_cast<double>(paths_));
  s.set("render", "camera paths per second",
        seconds > 0 ? static_cast<double>(paths_) / seconds : 0);
  s.set("render", "rays", static_cast<double>(rays_.closest));
  s.set("render", "shadow rays", static_cast<double>(rays_.shadow));
  s.set("render", "rays per second", seconds > 0 ? total / seconds : 0);
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
                      const RadianceEstimator& estimator) {
  return PassRenderer(context, pixels, estimator).run();
}

}  // namespace lampyris
