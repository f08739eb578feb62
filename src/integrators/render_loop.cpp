// SPDX-License-Identifier: Apache-2.0
#include "integrators/render_loop.h"

#include <fmt/format.h>

#include <algorithm>
#include <mutex>
#include <numeric>

#include "core/parallel.h"
#include "integrators/bad_samples.h"
#include "integrators/pass_loop.h"

namespace lampyris {

namespace {

constexpr int kObservedTileSize = 8;

uint64_t targetOf(const RenderContext& context) {
  const RenderOptions& o = context.options;
  if (o.sampleCount > 0) return o.sampleCount;
  if (o.seconds > 0 || o.noise > 0) return 0;
  return static_cast<uint64_t>(context.sampler.samplesPerPixel());
}

class PassRenderer final : public PassLoop {
 public:
  PassRenderer(RenderContext& context, const PixelBounds& pixels,
               const RadianceEstimator& estimator, PassObserver* observer)
      : PassLoop(context, targetOf(context), observer == nullptr, observer),
        pixels_(pixels),
        estimator_(estimator),
        observer_(observer),
        aovs_(context.film.aovs()),
        // As in pbrt-v3: the footprint of one of several samples is smaller than the pixel.
        differentialScale_(
            1 / std::sqrt(static_cast<float>(std::max(1, context.sampler.samplesPerPixel())))) {
    for (const auto& m : context.scene.materials)
      if (m->wantsDifferentials()) differentials_ = true;
    for (int y = pixels.min.y; y < pixels.max.y; ++y)
      for (int x = pixels.min.x; x < pixels.max.x; ++x)
        earlierPaths_ += context.film.sampleCount({x, y});
    if (observer_) {
      tileSize_ = kObservedTileSize;
      return;
    }
    // Small images are cut finer so that all threads have work to the end.
    const int64_t wanted = 8LL * threadCount();
    while (tileSize_ > 2 && tilesAcross() * tilesDown() < wanted) tileSize_ /= 2;
  }

  uint64_t render();

 private:
  int64_t tilesAcross() const { return (pixels_.size().x + tileSize_ - 1) / tileSize_; }
  int64_t tilesDown() const { return (pixels_.size().y + tileSize_ - 1) / tileSize_; }
  double perPixel(uint64_t paths) const {
    return static_cast<double>(paths) / static_cast<double>(pixels_.area());
  }
  Pass renderPass(uint64_t samples) override;
  Samples samples() const override { return {perPixel(earlierPaths_ + paths_), paths_}; }
  void renderTile(int64_t tile, uint64_t end);
  void renderPixel(SampleAddress address, uint64_t end, RenderState& state, BadSamples& bad) const;
  void renderSample(const SampleAddress& address, RenderState& state, BadSamples& bad) const;
  void tileDone(uint64_t paths, bool whole, const RenderState& state, const BadSamples& bad);

  const PixelBounds pixels_;
  const RadianceEstimator& estimator_;
  PassObserver* const observer_;
  const AovSet aovs_;
  const float differentialScale_;
  bool differentials_ = false;
  int tileSize_ = 16;
  uint64_t earlierPaths_ = 0;  ///< that the film had of these pixels at the start

  std::mutex mutex_;  ///< guards what follows, and the progress callback
  uint64_t paths_ = 0;
  int64_t wholeTiles_ = 0;  ///< of the pass, that were not cut short
  RayCounts rays_;
  DirectCounts direct_;
  BadSamples bad_;
};

uint64_t PassRenderer::render() {
  const uint64_t samples = run();
  report(rays_);
  direct_.report(context_.statistics);
  bad_.report(context_.statistics);
  return samples;
}

/// A number without a common divisor with `count`, about the golden section of it.
int64_t strideFor(int64_t count) {
  auto stride = static_cast<int64_t>(0.618 * static_cast<double>(count));
  while (std::gcd(stride, count) != 1) ++stride;
  return stride;
}

PassLoop::Pass PassRenderer::renderPass(uint64_t wanted) {
  const uint64_t samples = estimator_.beginPass(options_.firstIndex + done_, wanted);
  const int64_t tiles = tilesAcross() * tilesDown();
  // A pass that may be cut short takes the tiles of the whole image evenly.
  const int64_t stride = hasDeadline() ? strideFor(tiles) : 1;
  const uint64_t end = options_.firstIndex + done_ + samples;
  const uint64_t pathsBefore = paths_;
  wholeTiles_ = 0;
  if (observer_)
    observer_->beginPass({samples, static_cast<size_t>(tiles), done_ + samples == target_});
  parallelFor(static_cast<size_t>(tiles), 1, [&](size_t first, size_t last) {
    for (size_t t = first; t < last && !cutShort(); ++t)
      renderTile(static_cast<int64_t>(t) * stride % tiles, end);
  });
  const double mean = perPixel(paths_ - pathsBefore);
  if (wholeTiles_ != tiles) return {0, mean};
  if (observer_) observer_->endPass();
  return {samples, mean};
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
      const SampleAddress first{{x, y}, options_.firstIndex + context_.film.sampleCount({x, y})};
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
    const double before = timed ? seconds() : 0;
    renderSample(address, state, bad);
    if (timed) record.seconds = seconds() - before;
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
    if (differentials_) camera.scaleDifferentials(differentialScale_);
    if (state.aov) state.aov->cameraPoint = camera.ray.o;
    stream.setDimension(kFirstPathDimension);
    radiance = estimator_.radiance(camera, stream, state) * camera.weight;
  }
  if (!context_.film.addSample(address.pixel, radiance, filtered.weight))
    bad.add(address, radiance);
}

void PassRenderer::tileDone(uint64_t paths, bool whole, const RenderState& state,
                            const BadSamples& bad) {
  const std::lock_guard lock(mutex_);
  paths_ += paths;
  wholeTiles_ += whole ? 1 : 0;
  rays_ += state.rays;
  direct_ += state.direct;
  if (!bad.empty()) bad_.merge(bad);
  tellProgress();
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
  return PassRenderer(context, pixels, estimator, observer).render();
}

}  // namespace lampyris
