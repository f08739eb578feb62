// SPDX-License-Identifier: Apache-2.0
#include "lightdistributions/brdf.h"

#include <gtest/gtest.h>

#include "core/sampling.h"
#include "light_scenes.h"
#include "materials/disney_lobes.h"
#include "materials/lambert.h"
#include "materials/microfacet_reflection.h"
#include "support/statistics.h"

namespace lampyris::test {
namespace {

constexpr ConductorFresnel kMetal{Rgb(0.2f), Rgb(3)};

/// A point in the middle of the floor of the unit cube.
struct FloorPoint {
  Bsdf bsdf;
  LightSampleContext context;

  explicit FloorPoint(const Vec3& wo) {
    SurfaceInteraction at;
    at.p = Vec3(0.5f, 0.5f, 0);
    at.wo = normalize(wo);
    bsdf.reset(at);
    interaction_ = at;
  }
  const LightSampleContext& finish() { return context = LightSampleContext(interaction_, bsdf); }

 private:
  SurfaceInteraction interaction_;
};

/// What the light gives the viewer.
double radiance(const LightScene& scene, const LightSampleContext& c, LightId light) {
  const auto entry = scene.table[light];
  const auto s = entry.light->sample(entry.element, c.p, {0.5f, 0.5f});
  if (!s) return 0;
  return static_cast<double>((c.bsdf->f(c.wo, s->wi) * s->radiance).luminance() *
                             c.bsdf->absCosTheta(s->wi) / s->pdf);
}

/// Relative variance of the estimate by one light.
double variance(const LightScene& scene, const LightDistribution& d, const LightSampleContext& c) {
  double sum = 0, squares = 0;
  for (LightId l = 0; l < scene.table.size(); ++l) {
    const double value = radiance(scene, c, l);
    sum += value;
    if (value > 0) squares += value * value / static_cast<double>(d.pmf(c, l));
  }
  return squares / (sum * sum) - 1;
}

TEST(Brdf, FindsTheLightsInTheLobe) {
  const auto scene = manyLights(4000);
  DistributionMaker maker;
  const auto brdf = maker.make("brdf", *scene), bvh = maker.make("bvh", *scene);
  for (const float alpha : {0.003f, 0.03f, 0.2f}) {
    FloorPoint at(Vec3(-1, 0.2f, 1.2f));
    at.bsdf.add<MicrofacetReflection<ConductorFresnel>>(Rgb(1), TrowbridgeReitz(alpha, alpha),
                                                        kMetal);
    const LightSampleContext& c = at.finish();
    const double mine = variance(*scene, *brdf, c);
    EXPECT_LT(mine, 0.1 * variance(*scene, *bvh, c)) << alpha;
    EXPECT_LT(mine, 2) << alpha;
  }
}

TEST(Brdf, FindsTheLightsInAClearcoat) {
  const auto scene = manyLights(4000);
  DistributionMaker maker;
  const auto brdf = maker.make("brdf", *scene), bvh = maker.make("bvh", *scene);
  for (const float gloss : {0.f, 0.5f, 1.f}) {
    FloorPoint at(Vec3(-1, 0.2f, 1.2f));
    at.bsdf.add<DisneyClearcoat>(1.f, gloss);
    const LightSampleContext& c = at.finish();
    EXPECT_LT(variance(*scene, *brdf, c), 0.25 * variance(*scene, *bvh, c)) << gloss;
  }
}

TEST(Brdf, WeighsDiffuseLobesAgainstGlossyOnes) {
  const auto scene = manyLights(4000);
  DistributionMaker maker;
  const auto brdf = maker.make("brdf", *scene), bvh = maker.make("bvh", *scene);
  FloorPoint at(Vec3(-1, 0.2f, 1.2f));
  at.bsdf.add<LambertReflection>(Rgb(0.5f));
  at.bsdf.add<MicrofacetReflection<DielectricFresnel>>(Rgb(1), TrowbridgeReitz(0.05f, 0.05f),
                                                       DielectricFresnel{1.5f});
  const LightSampleContext& c = at.finish();
  EXPECT_LT(variance(*scene, *brdf, c), 0.5 * variance(*scene, *bvh, c));
}

TEST(Brdf, IsThePlainTreeAtDiffusePoints) {
  const auto scene = manyLights(300);
  DistributionMaker maker;
  const auto brdf = maker.make("brdf", *scene), bvh = maker.make("bvh", *scene);
  FloorPoint at(Vec3(-1, 0.2f, 1.2f));
  at.bsdf.add<LambertReflection>(Rgb(0.5f));
  const LightSampleContext& c = at.finish();
  for (LightId l = 0; l < scene->table.size(); ++l) EXPECT_EQ(brdf->pmf(c, l), bvh->pmf(c, l));
}

TEST(Brdf, ThresholdSetsTheCut) {
  const auto scene = manyLights(1500);
  FloorPoint at(Vec3(-1, 0.2f, 1.2f));
  at.bsdf.add<MicrofacetReflection<ConductorFresnel>>(Rgb(1), TrowbridgeReitz(0.1f, 0.1f), kMetal);
  const LightSampleContext& c = at.finish();
  const BrdfReceiver receiver(c);
  ASSERT_TRUE(receiver.isGlossy());
  DistributionMaker maker;
  size_t before = BrdfCut::kCapacity + 1;
  for (const char* threshold : {"0.005", "0.05", "0.3", "0.7"}) {
    const auto lights = maker.make("brdf", *scene, {{"cutthreshold", threshold}});
    const auto& brdf = dynamic_cast<const BrdfLightDistribution&>(*lights);
    const BrdfVertex vertex(brdf, c, receiver);
    EXPECT_LE(vertex.cutSize(), before);
    before = vertex.cutSize();
    // Lights are points: no cluster that is one of them is over the threshold, unless that would
    // take more clusters than there may be.
    EXPECT_LE(vertex.importance(), std::max(0.1f, std::stof(threshold)));
    double sum = 0;
    for (LightId l = 0; l < scene->table.size(); ++l) {
      ASSERT_EQ(vertex.pmf(l), lights->pmf(c, l));
      sum += static_cast<double>(vertex.pmf(l));
    }
    EXPECT_NEAR(sum, 1, 1e-4);
    for (uint64_t i = 0; i < 500; ++i) {
      const auto s = vertex.sample(uniform(2, i, 0));
      ASSERT_TRUE(s);
      ASSERT_EQ(s->pmf, vertex.pmf(s->light));
    }
  }
}

TEST(Brdf, KnowsHowMuchSingleLightsMatter) {
  FloorPoint at(Vec3(-1, 0.2f, 1.2f));
  at.bsdf.add<MicrofacetReflection<ConductorFresnel>>(Rgb(1), TrowbridgeReitz(0.1f, 0.1f), kMetal);
  const LightSampleContext& c = at.finish();
  const BrdfReceiver receiver(c);
  DistributionMaker maker;
  const auto share = [&](const LightScene& scene, const char* threshold) {
    const auto lights = maker.make("brdf", scene, {{"cutthreshold", threshold}});
    const auto& brdf = dynamic_cast<const BrdfLightDistribution&>(*lights);
    return BrdfVertex(brdf, c, receiver).shareOfSingleLights();
  };
  EXPECT_NEAR(share(*manyLights(6), "0.5"), 1, 1e-6);
  const auto many = manyLights(1500);
  EXPECT_EQ(share(*many, "1"), 0);
  EXPECT_GT(share(*many, "0.001"), 0.1);
}

}  // namespace
}  // namespace lampyris::test
