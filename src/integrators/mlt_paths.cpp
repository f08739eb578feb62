// SPDX-License-Identifier: Apache-2.0
// Multiplexing (Hachisuka, Kaplanyan and Dachsbacher 2014, "Multiplexed Metropolis Light
// Transport"): one number of the point chooses how the path is made, so a path costs as much as one
// edge between two walks and not as all of them, and chains find the strategies that suit it.
#include "integrators/mlt_paths.h"

#include <algorithm>

namespace lampyris {

namespace {

/// The camera's vertex draws nothing: these dimensions are free.
constexpr uint32_t kStrategyDimension = kFirstPathDimension;

/// All pixels about which a filter of the film reaches.
PixelBounds reachOf(const Film& film) {
  const Int2 beyond(glm::ceil(film.filter().radius() - 0.5f));
  const PixelBounds b = film.bounds();
  return {b.min - beyond, b.max + beyond};
}

bool contains(const PixelBounds& area, const Vec2& at) {
  const Vec2 low(area.min), high(area.max);
  return at.x >= low.x && at.y >= low.y && at.x < high.x && at.y < high.y;
}

}  // namespace

MltPaths::MltPaths(const RenderContext& context, const LightDistribution* distribution,
                   float differentialScale)
    : camera_(context.camera),
      area_(reachOf(context.film)),
      areaFactor_(static_cast<float>(area_.area()) /
                  static_cast<float>(context.film.bounds().area())),
      differentialScale_(differentialScale),
      paths_(context, distribution, area_) {}

size_t MltPaths::dimensions(int depth) { return lightDimension(static_cast<size_t>(depth) + 2); }

Splat MltPaths::path(int depth, const PrimarySamples& numbers, RayCounts& rays) const {
  SampleStream stream(numbers, {});
  CameraSample sample;
  sample.film = Vec2(area_.min) + stream.next2D() * Vec2(area_.size());
  sample.lens = stream.next2D();
  sample.time = stream.next1D();
  stream.setDimension(kStrategyDimension);
  const auto count = static_cast<float>(paths_.strategyCount(depth));
  const auto number = static_cast<size_t>(std::min(stream.next1D() * count, count - 1));
  const PathStrategy strategy = paths_.strategy(depth, number);
  CameraRay camera = camera_.generate(sample);
  camera.scaleDifferentials(differentialScale_);
  const bool fromCamera = strategy.fromCamera > 1;
  const float weight = fromCamera ? camera.weight * areaFactor_ : 1;
  if (!(weight > 0)) return {};
  const NumberSequence more(numbers.steadySeed());
  Splat splat = paths_.one(strategy, sample.film, camera, stream, more, rays);
  splat.value *= contains(area_, splat.film) ? weight * count : 0.f;
  return splat;
}

}  // namespace lampyris
