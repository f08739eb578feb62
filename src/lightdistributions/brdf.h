// SPDX-License-Identifier: Apache-2.0
/// Lights by what the BSDF makes of them: Liu, Xu and Yan 2019, "Adaptive BRDF-Oriented Multiple
/// Importance Sampling of Many Lights", §4.1.
///
/// Deviations: infinite and distant lights lie beside the tree, as for "bvh"; a point without
/// glossy lobes draws from the plain tree. Cost per vertex: see brdf_cut.h.
#pragma once

#include "lightdistributions/brdf_cut.h"
#include "lightdistributions/bvh.h"

namespace lampyris {

struct BrdfParameters {
  BvhParameters tree;
  float cutThreshold = 0.5f;

  /// Splitting is what helps where nothing is glossy; measured, docs/brdf-oriented-mis.md.
  BrdfParameters() { tree.splitThreshold = 0.5f, tree.maxCut = 6; }
  void declare(Declaration& d) {
    tree.declare(d);
    d.add("cutthreshold", cutThreshold,
          "A cluster of lights is split where the glossy lobes' integral over its bounding sphere "
          "exceeds this.")
        .range(0, 1);
  }
};

class BrdfLightDistribution final : public LightDistribution {
 public:
  BrdfLightDistribution(const BrdfParameters& parameters, const LightDistributionContext& context);

  std::optional<SampledLight> sample(const LightSampleContext& ctx, float u) const override;
  float pmf(const LightSampleContext& ctx, LightId light) const override;

  /// The same lights without a look at the BSDF.
  const LightDistribution& plain() const { return *plain_; }

 private:
  friend class BrdfVertex;
  BrdfLightDistribution(const BrdfParameters& parameters, LightBVHAccel binary,
                        const LightDistributionContext& context);

  const std::shared_ptr<const WideLightBVH> tree_;  ///< unless the plain one is binary, its
  const InfiniteLights infinite_;
  const std::unique_ptr<LightDistribution> plain_;
  const float cutThreshold_;
  bool environment_ = false;  ///< light may come from everywhere
};

/// One glossy point and its cut, for many draws.
class BrdfVertex {
 public:
  BrdfVertex(const BrdfLightDistribution& lights, const LightSampleContext& ctx,
             const BrdfReceiver& receiver);

  std::optional<SampledLight> sample(float u) const;
  float pmf(LightId light) const;
  /// The paper's I_B (eq. 8) in [0, 1]: the largest integral of the glossy lobes over a cluster of
  /// the cut.
  float importance() const { return importance_; }
  size_t cutSize() const { return cut_.size(); }
  /// How much of the importance of the cut is that of clusters of one light, in [0, 1].
  float shareOfSingleLights() const { return cut_.shareOfSingleLights(); }

 private:
  const BrdfLightDistribution& lights_;
  const LightSampleContext& ctx_;
  const BrdfReceiver& receiver_;
  LightReceiver plain_;
  BrdfCut cut_;
  double shareOfInfinite_ = 0;
  float importance_;
};

}  // namespace lampyris
