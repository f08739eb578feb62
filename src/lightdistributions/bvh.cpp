// SPDX-License-Identifier: Apache-2.0
/// Lights by their importance for the point: Ma 2018, "Importance Sampling with Light BVH"
/// (thesis), ch. 3, without splitting. Deviation: infinite and distant lights, which the thesis
/// leaves out, lie beside the tree and are weighed against it by irradiance. Cost per sample: two
/// node importances a level of the tree and one irradiance estimate an infinite light.
#include "lightdistributions/light_set.h"

namespace lampyris {
namespace {

struct BvhParameters {
  void declare(Declaration&) {}
};

class BvhLightDistribution final : public LightDistribution {
 public:
  explicit BvhLightDistribution(const LightDistributionContext& context)
      : tree_(makeLightTree(context)), infinite_(context.lights) {}

  std::optional<SampledLight> sample(const LightSampleContext& ctx, float u) const override {
    const LightReceiver at(ctx);
    double variate = refineVariate(u, ctx.p);
    if (infinite_.empty()) return tree_.sample(at, variate);
    const double share = shareOfInfinite(at);
    const bool infinite = chooseFirst(share, 1 - share, variate);
    auto drawn = infinite ? infinite_.sample(at, variate) : tree_.sample(at, variate);
    if (drawn) drawn->pmf *= static_cast<float>(infinite ? share : 1 - share);
    return drawn;
  }
  float pmf(const LightSampleContext& ctx, LightId light) const override {
    const LightReceiver at(ctx);
    if (infinite_.empty()) return tree_.pmf(at, light);
    const double share = shareOfInfinite(at);
    return infinite_.contains(light) ? infinite_.pmf(at, light) * static_cast<float>(share)
                                     : tree_.pmf(at, light) * static_cast<float>(1 - share);
  }

 private:
  double shareOfInfinite(const LightReceiver& at) const {
    return infiniteShare(infinite_.irradiance(at), static_cast<double>(tree_.rootImportance(at)));
  }

  LightBVHAccel tree_;
  InfiniteLights infinite_;
};

std::unique_ptr<LightDistribution> create(const BvhParameters&,
                                          const LightDistributionContext& context) {
  return std::make_unique<BvhLightDistribution>(context);
}

}  // namespace

LightDistributionRegistry::Entry bvhLightDistributionPlugin() {
  return makePlugin("bvh", "Lights by importance at the point, through a tree over them.", create);
}

}  // namespace lampyris
