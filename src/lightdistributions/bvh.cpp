// SPDX-License-Identifier: Apache-2.0
/// Lights by their importance for the point: Ma 2018, "Importance Sampling with Light BVH"
/// (thesis), ch. 3. Deviations: infinite and distant lights, which the thesis leaves out, lie
/// beside the tree and are weighed against it by irradiance; the tree is the wide form by default.
/// Cost per sample: the importances of a node's children a level of the tree, and one irradiance
/// estimate an infinite light.
#include "lightdistributions/bvh.h"

namespace lampyris {

void BvhParameters::declare(Declaration& d) {
  d.add("tree", tree, "Form of the tree: eight children a node, or two, which never splits.")
      .oneOf({"wide", "binary"});
  d.add("factors", factors,
        "How the importance of a cluster takes in angles: means over it, bounds, or bounds without "
        "the receiver's cosine. The latter two need \"tree\" \"binary\".")
      .oneOf({"mean", "bound", "thesis"});
  d.add("splitthreshold", splitThreshold,
        "How near for its size a cluster of lights must be to give more than one light. 1: "
        "never; 0: always.")
      .range(0, 1);
  d.add("maxcut", maxCut, "The most lights that splitting draws for a point.").range(1, 65536);
}

namespace {

/// The tree, and beside it the lights without a position.
template <class Tree>
class BvhLightDistribution : public LightDistribution {
 public:
  BvhLightDistribution(std::shared_ptr<const Tree> tree, const LightTable& lights,
                       LightFactors factors = LightFactors::Mean)
      : owner_(std::move(tree)), tree_(*owner_), infinite_(lights), factors_(factors) {}

  std::optional<SampledLight> sample(const LightSampleContext& ctx, float u) const override {
    const LightReceiver at(ctx, factors_);
    double variate = refineVariate(u, ctx.p);
    if (infinite_.empty()) return tree_.sample(at, variate);
    const double share = shareOfInfinite(at);
    if (!chooseFirst(share, 1 - share, variate))
      return scaled(tree_.sample(at, variate), 1 - share);
    return scaled(infinite_.sample(at, variate), share);
  }
  float pmf(const LightSampleContext& ctx, LightId light) const override {
    const LightReceiver at(ctx, factors_);
    if (infinite_.empty()) return tree_.pmf(at, light);
    const double share = shareOfInfinite(at);
    return infinite_.contains(light) ? infinite_.pmf(at, light) * static_cast<float>(share)
                                     : tree_.pmf(at, light) * static_cast<float>(1 - share);
  }

 protected:
  double shareOfInfinite(const LightReceiver& at) const {
    return infiniteShare(infinite_.irradiance(at), static_cast<double>(tree_.rootImportance(at)));
  }
  static std::optional<SampledLight> scaled(std::optional<SampledLight> drawn, double share) {
    if (drawn) drawn->pmf *= static_cast<float>(share);
    return drawn;
  }

  const std::shared_ptr<const Tree> owner_;
  const Tree& tree_;
  const InfiniteLights infinite_;
  const LightFactors factors_;
};

/// Several lights a point: one of each cluster, and one of those without a position.
class SplittingLightDistribution final : public BvhLightDistribution<WideLightBVH> {
 public:
  SplittingLightDistribution(std::shared_ptr<const WideLightBVH> tree, const LightTable& lights,
                             LightSplitting splitting)
      : BvhLightDistribution(std::move(tree), lights), splitting_(splitting) {}

  bool splits() const override { return true; }
  void sampleCut(const LightSampleContext& ctx, float u, SampledLights& out) const override {
    const LightReceiver at(ctx);
    const double variate = refineVariate(u, ctx.p);
    tree_.sampleCut(at, variate, splitting_.forPoint(ctx.worth), out);
    if (infinite_.empty()) return;
    if (const auto drawn = infinite_.sample(at, variate)) out.push_back(*drawn);
  }
  float expectedCount(const LightSampleContext& ctx, LightId light) const override {
    const LightReceiver at(ctx);
    return infinite_.contains(light)
               ? infinite_.pmf(at, light)
               : tree_.expectedCount(at, light, splitting_.forPoint(ctx.worth));
  }

 private:
  const LightSplitting splitting_;
};

}  // namespace

std::unique_ptr<LightDistribution> makeBvhLights(const BvhParameters& p, LightBVHAccel binary,
                                                 const LightDistributionContext& context) {
  if (p.tree == "binary") {
    if (p.splitThreshold < 1)
      throw SceneError(context.location, "\"splitthreshold\" below 1 needs \"tree\" \"wide\"");
    const LightFactors factors = p.factors == "mean"    ? LightFactors::Mean
                                 : p.factors == "bound" ? LightFactors::Bound
                                                        : LightFactors::Thesis;
    return std::make_unique<BvhLightDistribution<LightBVHAccel>>(
        std::make_shared<const LightBVHAccel>(std::move(binary)), context.lights, factors);
  }
  return makeWideBvhLights(
      p, std::make_shared<const WideLightBVH>(makeWideLightTree(binary, context)), context);
}

std::unique_ptr<LightDistribution> makeWideBvhLights(const BvhParameters& p,
                                                     std::shared_ptr<const WideLightBVH> tree,
                                                     const LightDistributionContext& context) {
  if (p.factors != "mean")
    throw SceneError(context.location, "\"factors\" other than \"mean\" need \"tree\" \"binary\"");
  const LightSplitting splitting(p.splitThreshold, static_cast<uint32_t>(p.maxCut));
  if (splitting.never())
    return std::make_unique<BvhLightDistribution<WideLightBVH>>(std::move(tree), context.lights);
  return std::make_unique<SplittingLightDistribution>(std::move(tree), context.lights, splitting);
}

namespace {

std::unique_ptr<LightDistribution> create(const BvhParameters& p,
                                          const LightDistributionContext& context) {
  return makeBvhLights(p, makeLightTree(context), context);
}

}  // namespace

LightDistributionRegistry::Entry bvhLightDistributionPlugin() {
  return makePlugin("bvh", "Lights by importance at the point, through a tree over them.", create);
}

}  // namespace lampyris
