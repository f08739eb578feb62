// SPDX-License-Identifier: Apache-2.0
/// The loop over passes, tiles, pixels and samples that all path-like integrators share.
#pragma once

#include <array>
#include <memory>
#include <vector>

#include "base/bsdf.h"
#include "base/integrator.h"
#include "base/medium.h"

namespace lampyris {

/// Rays traced; counted locally and added up once a tile.
struct RayCounts {
  uint64_t closest = 0;  ///< nearest-hit queries
  uint64_t shadow = 0;   ///< occlusion queries
  TrackingCounts tracking;

  RayCounts& operator+=(const RayCounts& o) {
    return closest += o.closest, shadow += o.shadow, tracking += o.tracking, *this;
  }
};

/// How direct lighting shared its samples out, over the points where it did (adaptive_direct.h).
struct DirectCounts {
  uint64_t points = 0, glossyPoints = 0;
  uint64_t treeSamples = 0;   ///< of the light tree's cut
  uint64_t cutClusters = 0;   ///< of the BRDF-oriented cut, at glossy points
  uint64_t lightSamples = 0;  ///< BRDF-oriented, at glossy points
  uint64_t bsdfSamples = 0;   ///< at glossy points
  uint64_t bsdfHits = 0;      ///< of these, how many found light
  /// Of some points, by technique: the tree's cut, BRDF-oriented lights, BSDF samples.
  std::array<double, 3> seconds{};

  DirectCounts& operator+=(const DirectCounts& o);
  void report(Statistics& statistics) const;
};

/// What an estimator keeps from sample to sample of a tile; estimators derive from it.
class EstimatorMemory {
 public:
  virtual ~EstimatorMemory() = default;
};

/// What a thread keeps from sample to sample, so that a sample allocates and clears nothing large.
struct RenderState {
  Bsdf bsdf;
  RayCounts rays;
  AovRecord* aov = nullptr;                 ///< of the sample being made; null: nobody asked
  std::unique_ptr<EstimatorMemory> memory;  ///< of RadianceEstimator::makeMemory()
  DirectCounts direct;
};

/// Estimates the radiance that arrives along a camera ray. Thread-safe.
class RadianceEstimator {
 public:
  virtual ~RadianceEstimator() = default;
  /// One estimate, a pure function of the arguments. `stream` stands at kFirstPathDimension.
  virtual Rgb radiance(const CameraRay& camera, SampleStream& stream, RenderState& state) const = 0;
  virtual std::unique_ptr<EstimatorMemory> makeMemory() const { return nullptr; }
  /// Called before each pass, from one thread: the next samples of all pixels are number `first`
  /// and on, `samples` of them. Returns how many of these, ≥ 1, it is ready for: the pass is as
  /// long.
  virtual uint64_t beginPass(uint64_t first, uint64_t samples) const {
    return (void)first, samples;
  }
};

/// Learns between passes. With an observer, tiles and the sizes of passes depend neither on the
/// number of threads nor, but for a limit of time, on time: passes are of 1, 1, 2, 4, 8 … samples a
/// pixel.
class PassObserver : public LearnedState {
 public:
  struct Pass {
    uint64_t samples = 0;  ///< a pixel
    size_t tiles = 0;
    bool isLast = false;  ///< as far as is known: nothing will use what is learned
  };
  virtual ~PassObserver() = default;
  virtual void beginPass(const Pass& pass) = 0;
  /// Called by several threads at once, for each tile once a pass.
  virtual void tileDone(size_t tile, RenderState& state) = 0;
  /// Not called for a pass that was cut short.
  virtual void endPass() = 0;
};

/// Dimensions 0–1 are the position on the film, 2–3 on the lens, 4 the time. The first one left is
/// odd: with one number before each pair, pairs start at even dimensions.
inline constexpr uint32_t kFirstPathDimension = 5;

/// The pixels that the film and an integrator's parameter "pixelbounds" (x0 x1 y0 y1, empty: all)
/// have in common. Throws SceneError if there are none or the list is not four numbers.
PixelBounds renderedPixels(const Film& film, const std::vector<int>& pixelBounds,
                           SourceLocation location);

/// Renders the samples of all pixels up to the count or time that the options want. Every pixel
/// goes on from the number of samples that the film has of it. Returns the number of samples that
/// all pixels have at the end.
uint64_t renderPasses(RenderContext& context, const PixelBounds& pixels,
                      const RadianceEstimator& estimator, PassObserver* observer = nullptr);

}  // namespace lampyris
