// SPDX-License-Identifier: Apache-2.0
#include "lightdistributions/brdf.h"

namespace lampyris {

BrdfLightDistribution::BrdfLightDistribution(const BrdfParameters& parameters,
                                             const LightDistributionContext& context)
    : BrdfLightDistribution(parameters, makeLightTree(context), context) {}

BrdfLightDistribution::BrdfLightDistribution(const BrdfParameters& parameters, LightBVHAccel binary,
                                             const LightDistributionContext& context)
    : tree_(std::make_shared<const WideLightBVH>(makeWideLightTree(binary, context))),
      infinite_(context.lights),
      plain_(parameters.tree.tree == "binary"
                 ? makeBvhLights(parameters.tree, std::move(binary), context)
                 : makeWideBvhLights(parameters.tree, tree_, context)),
      cutThreshold_(parameters.cutThreshold) {
  for (size_t o = 0; o < context.lights.objectCount(); ++o) {
    const Light& light = context.lights.object(o);
    environment_ |= light.isInfinite() && !light.isDelta() && !light.power(0).isBlack();
  }
}

std::optional<SampledLight> BrdfLightDistribution::sample(const LightSampleContext& ctx,
                                                          float u) const {
  if (!BrdfReceiver::isWorthwhile(ctx)) return plain_->sample(ctx, u);
  const BrdfReceiver receiver(ctx);
  return receiver.isGlossy() ? BrdfVertex(*this, ctx, receiver).sample(u) : plain_->sample(ctx, u);
}

float BrdfLightDistribution::pmf(const LightSampleContext& ctx, LightId light) const {
  if (!BrdfReceiver::isWorthwhile(ctx)) return plain_->pmf(ctx, light);
  const BrdfReceiver receiver(ctx);
  return receiver.isGlossy() ? BrdfVertex(*this, ctx, receiver).pmf(light)
                             : plain_->pmf(ctx, light);
}

BrdfVertex::BrdfVertex(const BrdfLightDistribution& lights, const LightSampleContext& ctx,
                       const BrdfReceiver& receiver)
    : lights_(lights),
      ctx_(ctx),
      receiver_(receiver),
      plain_(ctx),
      cut_(*lights.tree_, receiver, lights.cutThreshold_),
      importance_(cut_.largestIntegral()) {
  const InfiniteLights& infinite = lights.infinite_;
  if (!infinite.empty()) {
    // The cut's importance is a radiance: so must be that of the others.
    const auto perIrradiance = static_cast<double>(receiver.albedo() * kInvPi);
    shareOfInfinite_ =
        infiniteShare(infinite.irradiance(plain_) * perIrradiance, cut_.importance());
    // An environment is a cluster on all sides.
    if (lights.environment_)
      importance_ =
          std::max(importance_, static_cast<float>(shareOfInfinite_) * receiver.glossyAlbedo());
  }
  importance_ = std::min(importance_, 1.f);
}

std::optional<SampledLight> BrdfVertex::sample(float u) const {
  double variate = refineVariate(u, ctx_.p);
  const InfiniteLights& infinite = lights_.infinite_;
  if (infinite.empty()) return cut_.sample(receiver_, variate);
  const bool fromInfinite = chooseFirst(shareOfInfinite_, 1 - shareOfInfinite_, variate);
  auto drawn = fromInfinite ? infinite.sample(plain_, variate) : cut_.sample(receiver_, variate);
  const double share = fromInfinite ? shareOfInfinite_ : 1 - shareOfInfinite_;
  if (drawn) drawn->pmf *= static_cast<float>(share);
  return drawn;
}

float BrdfVertex::pmf(LightId light) const {
  const InfiniteLights& infinite = lights_.infinite_;
  if (infinite.contains(light))
    return infinite.pmf(plain_, light) * static_cast<float>(shareOfInfinite_);
  const float pmf = cut_.pmf(receiver_, light);
  return infinite.empty() ? pmf : pmf * static_cast<float>(1 - shareOfInfinite_);
}

namespace {

std::unique_ptr<LightDistribution> create(const BrdfParameters& p,
                                          const LightDistributionContext& context) {
  return std::make_unique<BrdfLightDistribution>(p, context);
}

}  // namespace

LightDistributionRegistry::Entry brdfLightDistributionPlugin() {
  return makePlugin("brdf",
                    "Lights by importance at the point and by how much of their light its glossy "
                    "lobes scatter to the viewer.",
                    create);
}

}  // namespace lampyris
