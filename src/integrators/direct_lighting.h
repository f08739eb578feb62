// SPDX-License-Identifier: Apache-2.0
/// Direct lighting at a point: light sampling and BSDF sampling joined by multiple importance
/// sampling (Veach 1997, chapter 9). A component of every integrator.
#pragma once

#include <algorithm>
#include <optional>

#include "base/integrator.h"
#include "integrators/light_connection.h"

namespace lampyris {

enum class LightStrategy : uint8_t {
  One,       ///< drawn from a LightDistribution: one light, or one of each cluster if it splits
  All,       ///< every light, as many samples as it asks for
  EachOnce,  ///< every light by one sample, and by no BSDF samples
};

/// Both techniques see each other through the expected number of draws times the density, so that a
/// light is weighed alike from either side however often it is sampled.
class DirectLighting {
 public:
  /// Cheap. `distribution` is used by LightStrategy::One and may be null if there are no lights.
  /// `mayCut` false: always one light.
  DirectLighting(const Scene& scene, LightStrategy strategy, const LightDistribution* distribution,
                 bool mayCut = true);

  /// False: light sampling is pointless.
  bool hasLights() const { return lightCount_ > 0; }
  /// Whether lightSamples() may trace more than one ray.
  bool drawsMany() const { return splits_ || strategy_ != LightStrategy::One; }
  /// False: no ray ever finds light.
  bool hasVisibleLights() const { return visible_; }
  /// How many dimensions lightSamples() takes; even.
  uint32_t lightDimensions() const { return lightDimensions_; }
  /// The same of bsdfSamples(); even.
  uint32_t bsdfDimensions() const { return 4 * static_cast<uint32_t>(bsdfDraws_); }

  /// The part of the light scattered at `at` towards at.wo that light sampling accounts for. Takes
  /// its numbers from stream.dimension() on. at.bsdf must be set; `time` is that of the rays.
  Rgb lightSamples(const LightSampleContext& at, float time, SampleStream& stream,
                   RayCounts& rays) const;
  /// The same as one connection with its weight in `value`, which counts where nothing occludes
  /// `shadow`: for callers that have something to do before they trace that ray. False: nothing is
  /// scattered. Not where drawsMany(). `ownShare`: of the point's own draws among all that the
  /// caller makes there; by it foundAtHit() and foundOutside() get their densities times the same.
  bool proposeLight(const LightSampleContext& at, float time, SampleStream& stream,
                    LightConnection& out, float ownShare = 1) const;
  /// Opens a light vertex and notes the lights that lightSamples() draws there with the same
  /// arguments, by drawing them again.
  void recordDraws(const LightSampleContext& at, SampleStream stream, AovRecord& record) const;
  /// The other part, by rays of its own: for integrators whose paths end here.
  Rgb bsdfSamples(const LightSampleContext& at, float time, SampleStream& stream,
                  RayCounts& rays) const;

  /// Radiance that a ray which left `from` with a non-specular BSDF sample of density `bsdfPdf`
  /// finds at `hit` (an emitter), times the weight of that technique.
  Rgb foundAtHit(const LightSampleContext& from, float bsdfPdf,
                 const SurfaceInteraction& hit) const;
  /// The same where it leaves the scene in direction `d`.
  Rgb foundOutside(const LightSampleContext& from, float bsdfPdf, const Vec3& d) const;
  /// Radiance from outside, unweighed: camera and specular rays.
  Rgb outside(const Vec3& d) const;

 private:
  /// How many samples of its own the light gets where all are sampled.
  int samplesOf(const Light& light) const {
    return strategy_ == LightStrategy::EachOnce ? 1 : std::max(1, light.samples());
  }
  /// How often lightSamples() draws the light, on average.
  float expectedDraws(const LightSampleContext& at, LightId light) const;
  /// One light of the distribution, and the numbers `u` of the point on it.
  std::optional<SampledLight> chooseLight(const LightSampleContext& at, SampleStream& stream,
                                          Vec2& u) const;
  /// One light of each cluster of the distribution's cut; valid until the thread's next one.
  const SampledLights& drawCut(const LightSampleContext& at, float choice) const;
  Rgb cutSamples(const LightSampleContext& at, float time, float choice, const Vec2& u,
                 RayCounts& rays) const;
  Rgb lightSample(const LightSampleContext& at, float time, const SampledLight& chosen,
                  const Vec2& u, RayCounts& rays) const;
  /// Of a connection: the weight of light sampling over its density.
  float weightOverDensity(const LightSampleContext& at, const SampledLight& chosen,
                          const LightConnection& c, float ownShare = 1) const;
  float bsdfWeight(const LightSampleContext& from, LightId light, float bsdfPdf,
                   float lightPdf) const;

  const Scene& scene_;
  const LightStrategy strategy_;
  const LightDistribution* const distribution_;
  const bool splits_;
  const uint32_t lightCount_;
  bool visible_ = false;
  int bsdfDraws_ = 1;
  uint32_t lightDimensions_ = 4;
};

}  // namespace lampyris
