// SPDX-License-Identifier: Apache-2.0
/// Light distributions: which light to sample next at a point.
#pragma once

#include <optional>
#include <vector>

#include "base/bsdf.h"
#include "base/light.h"
#include "base/medium.h"

namespace lampyris {

/// A point that wants light. Built once per vertex and used both to sample and to weigh.
struct LightSampleContext {
  Vec3 p{0}, pError{0};
  Vec3 n{0, 0, 1};   ///< geometric normal
  Vec3 ns{0, 0, 1};  ///< shading normal
  Vec3 wo{0, 0, 1};
  /// Whether light can arrive from the side of wo (as the geometric normal sees it), and from the
  /// other one.
  bool reflects = true, transmits = true;
  const Bsdf* bsdf = nullptr;            ///< null where there is no surface
  const PhaseFunction* phase = nullptr;  ///< of the medium there
  /// In [0, 1]: how many lights the point is worth, relative to the most that a cut may have.
  float worth = 1;

  LightSampleContext() = default;
  LightSampleContext(const SurfaceInteraction& at, const Bsdf& bsdf);

  /// What is scattered towards wo of light from `wi`: BSDF × |cos|, or the phase function. One of
  /// them must be set, as for pdf().
  Rgb scattered(const Vec3& wi) const {
    return bsdf ? bsdf->f(wo, wi) * bsdf->absCosTheta(wi) : Rgb(phase->p(wo, wi));
  }
  /// With which BSDF or phase function themselves draw `wi`, by solid angle.
  float pdf(const Vec3& wi) const { return bsdf ? bsdf->pdf(wo, wi) : phase->p(wo, wi); }
};

struct SampledLight {
  LightId light = kNoLight;
  float pmf = 0;  ///< exact probability of the draw, or the expected count in a cut

  SampledLight() = default;
  SampledLight(LightId light, float pmf) : light(light), pmf(pmf) {}
  // Member by member: a copy as one word would wait for both to be written.
  SampledLight(const SampledLight& o) : light(o.light), pmf(o.pmf) {}
  SampledLight& operator=(const SampledLight& o) {
    light = o.light;
    pmf = o.pmf;
    return *this;
  }
  ~SampledLight() = default;
};
using SampledLights = std::vector<SampledLight>;

/// Contract, tested for every registered distribution: sample() reports pmf(light); drawn
/// frequencies match; every light that contributes has pmf > 0. The pmf sum to 1, or to less where
/// a draw may end without a light: in a cluster of which no light can contribute. Thread-safe.
class LightDistribution {
 public:
  virtual ~LightDistribution() = default;
  /// One light; none where no light can contribute. `u` in [0, 1).
  virtual std::optional<SampledLight> sample(const LightSampleContext& ctx, float u) const = 0;
  virtual float pmf(const LightSampleContext& ctx, LightId light) const = 0;
  /// True if sampleCut() may draw more than one light.
  virtual bool splits() const { return false; }
  /// Appends one light for each cluster of the cut; by default sample()'s.
  virtual void sampleCut(const LightSampleContext& ctx, float u, SampledLights& out) const;
  /// How often sampleCut() draws the light on average; by default pmf().
  virtual float expectedCount(const LightSampleContext& ctx, LightId light) const {
    return pmf(ctx, light);
  }
};

class Statistics;

struct LightDistributionContext : BuildContext {
  const LightTable& lights;
  Bounds3 sceneBounds;
  Statistics& statistics;
};

using LightDistributionRegistry = Registry<LightDistribution, LightDistributionContext>;

}  // namespace lampyris
