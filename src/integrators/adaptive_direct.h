// SPDX-License-Identifier: Apache-2.0
/// Direct lighting by three techniques whose shares adapt to the point.
///
/// Liu, Xu and Yan 2019, "Adaptive BRDF-Oriented Multiple Importance Sampling of Many Lights",
/// §4.2 and §5: the light tree's cut (one sample a cluster), lights drawn by what the BSDF makes of
/// them, and BSDF samples. A glossy point takes N = N_max · I_B of the latter two (eq. 9), each of
/// them the one or the other by how often BSDF samples found light so far (Algorithm 1).
///
/// The paper's weights depend on later samples, which biases them. Here sample i counts as drawn
/// from the mixture m_i = p_i p_lights + (1 − p_i) p_bsdf, where p_i is a function of the samples
/// before, and has the weight N m_i / (n_T + N m_i) against the n_T draws of the tree; the tree's
/// samples, which are independent of all p_i, have the mean over i of n_T / (n_T + N m_i). In
/// expectation the weights add up to 1 for each i, whatever the p_i were. N is rounded at random
/// beforehand.
///
/// Further deviations: N is at least 1, because the tree alone meets peaks of the BSDF with
/// unbounded weights; points without glossy lobes take one BSDF sample and no cut; the tree's cut
/// is smaller where N is larger, but not where single lights matter; lights are sampled by solid
/// angle. Cost: a shadow ray or a ray and one light pmf by either tree a sample.
#pragma once

#include "base/integrator.h"
#include "integrators/light_connection.h"
#include "lightdistributions/brdf.h"

namespace lampyris {

/// How BRDF-aware samples are shared out between lights and BSDF.
enum class BrdfAllocation : uint8_t { Adaptive, Equal, Lights, Bsdf };

struct AdaptiveSettings {
  static constexpr int kMostSamples = 256;
  int maxSamples = 50;
  std::string allocation = "adaptive";

  void declare(Declaration& d);
  BrdfAllocation how() const;
};

/// The light distribution that AdaptiveDirect needs. Throws SceneError if `name`, which may be
/// empty, is that of another.
std::unique_ptr<LightDistribution> makeAdaptiveLights(const IntegratorContext& context,
                                                      const std::string& name);

class AdaptiveDirect {
 public:
  /// `lights` is from makeAdaptiveLights(). Keeps references.
  AdaptiveDirect(const Scene& scene, const AdaptiveSettings& settings,
                 const LightDistribution& lights);

  /// How many dimensions a point takes from an odd one on; even.
  static constexpr uint32_t kDimensions = 4096;

  /// Direct light by samples of lights and of the BSDF.
  struct Parts {
    Rgb lights, bsdf;
  };
  /// Direct light scattered at `at` towards at.wo. at.bsdf must be set; `time` is that of the rays.
  Parts radiance(const LightSampleContext& at, float time, SampleStream& stream,
                 RenderState& state) const;

  enum class Effort : uint8_t {
    Allocated,  ///< as radiance()
    One,        ///< one sample of each technique
  };
  /// How many draws the light that a continuation finds is weighed against.
  struct Allocation {
    int samples = 0;      ///< BRDF-aware ones, the continuation among them
    bool cut = false;     ///< whether the tree drew from its cut
    float treeWorth = 1;  ///< in [0, 1]: what part of it
  };
  /// The same for a path that goes on: without what its next ray, the last of the BSDF samples,
  /// finds.
  Parts lightSamples(const LightSampleContext& at, float time, Effort effort, SampleStream& stream,
                     RenderState& state, Allocation& allocation) const;
  /// Weighed radiance that the ray after lightSamples() finds; `bsdfPdf` > 0 is its density.
  Rgb foundAtHit(const LightSampleContext& from, const Allocation& allocation, float bsdfPdf,
                 const SurfaceInteraction& hit) const;
  Rgb foundOutside(const LightSampleContext& from, const Allocation& allocation, float bsdfPdf,
                   const Vec3& d) const;

 private:
  struct Point;
  enum class Purpose : uint8_t { Ending, Continued, ContinuedByOne };
  Parts estimate(const LightSampleContext& at, float time, Purpose purpose, SampleStream& stream,
                 RenderState& state, Allocation& allocation) const;
  int sampleCount(const Point& point, Purpose purpose, float u) const;
  static float treeWorth(const Point& point);
  float lightProbability(const Point& point, int i) const;
  Rgb brdfLightSample(Point& point, int i) const;
  Rgb bsdfSample(Point& point, int i) const;
  void drawFromTree(Point& point) const;
  Rgb treeSamples(Point& point) const;
  Rgb treeSample(Point& point, const SampledLight& chosen, const Vec2& u) const;
  float treeDraws(const LightSampleContext& at, bool cut, LightId light) const;
  float continuationWeight(const LightSampleContext& from, const Allocation& allocation,
                           float bsdfPdf, LightId light, float lightPdf) const;

  const Scene& scene_;
  const BrdfLightDistribution& lights_;
  const int maxSamples_;
  const BrdfAllocation how_;
  bool visible_ = false;  ///< whether any ray finds light
};

}  // namespace lampyris
