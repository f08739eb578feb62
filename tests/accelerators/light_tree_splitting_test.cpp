// SPDX-License-Identifier: Apache-2.0
/// Splitting: several lights a point.
#include <algorithm>
#include <set>

#include "light_trees.h"

namespace lampyris::test {
namespace {

SampledLights cutOf(const WideLightBVH& tree, const LightSampleContext& c, double u,
                    const LightSplitting& splitting) {
  SampledLights cut;
  tree.sampleCut(LightReceiver(c), u, splitting, cut);
  return cut;
}
double countOf(const WideLightBVH& tree, const LightSampleContext& c, size_t lights,
               const LightSplitting& splitting) {
  double sum = 0;
  for (LightId l = 0; l < lights; ++l)
    sum += static_cast<double>(tree.expectedCount(LightReceiver(c), l, splitting));
  return sum;
}

TEST(LightTreeSplitting, ThresholdOneDrawsWhatDescentDraws) {
  const Lights lights = makeLights(Kind::Cones, 500);
  const WideLightBVH tree{LightBVHAccel(lights)};
  const LightSplitting never(1, 64), budgetOfOne(0, 1);
  EXPECT_TRUE(never.never());
  for (uint64_t i = 0; i < 200; ++i) {
    const LightSampleContext c = makeContext(i, lights, 1);
    const auto u = static_cast<double>(random(i, 90));
    const auto drawn = tree.sample(LightReceiver(c), u);
    for (const LightSplitting& splitting :
         {never, budgetOfOne, LightSplitting(0, 64).forPoint(0)}) {
      const SampledLights cut = cutOf(tree, c, u, splitting);
      ASSERT_EQ(cut.size(), drawn ? 1u : 0u);
      if (!drawn) continue;
      EXPECT_EQ(cut[0].light, drawn->light);
      EXPECT_EQ(cut[0].pmf, drawn->pmf);
      EXPECT_EQ(tree.expectedCount(LightReceiver(c), drawn->light, splitting), drawn->pmf);
    }
  }
}

TEST(LightTreeSplitting, ThresholdZeroTakesAll) {
  for (const Kind kind : {Kind::Points, Kind::Coincident}) {
    const Lights lights = makeLights(kind, 300);
    const WideLightBVH tree{LightBVHAccel(lights)};
    const LightSampleContext c = volumeAt({40, 0, 0});
    std::set<LightId> taken;
    for (const SampledLight& s : cutOf(tree, c, 0.3, LightSplitting(0, 300))) {
      EXPECT_EQ(s.pmf, 1);
      taken.insert(s.light);
    }
    EXPECT_EQ(taken.size(), 300u);
    // With less than one light each, most of the budget is used wherever the lights are.
    EXPECT_GT(cutOf(tree, c, 0.3, LightSplitting(0, 40)).size(), 25u);
  }
}

TEST(LightTreeSplitting, FarClustersGiveOneLight) {
  const Lights lights = makeLights(Kind::Points, 300);
  const WideLightBVH tree{LightBVHAccel(lights)};
  const LightSplitting half(0.5f, 16);
  EXPECT_EQ(cutOf(tree, volumeAt(Vec3(100)), 0.3, half).size(), 1u);
  EXPECT_GE(cutOf(tree, volumeAt(Vec3(0.5f)), 0.3, half).size(), 8u);
}

// The thesis's program draws a direction at random to decide whether to split, so the cut, and with
// it the probability of a light, is no function of the point.
TEST(LightTreeSplitting, CutIsAFunctionOfThePoint) {
  for (const Kind kind : {Kind::Points, Kind::Line, Kind::Coincident}) {
    const Lights lights = makeLights(kind, 700);
    const WideLightBVH tree{LightBVHAccel(lights)};
    for (const auto& [threshold, maxCut] : {std::pair{0.3f, 7u}, {0.6f, 16u}, {0.f, 50u}})
      for (uint64_t i = 1; i < 30; ++i) {
        const LightSampleContext c = volumeAt(randomPoint(i, 50) * 2.f);
        const LightSplitting splitting(threshold, maxCut);
        // Each draw of point lights finds one, so a cut has as many lights as it has clusters.
        const size_t size = cutOf(tree, c, 0, splitting).size();
        EXPECT_NEAR(countOf(tree, c, lights.size(), splitting), static_cast<double>(size), 1e-3);
        for (int k = 1; k < 20; ++k) EXPECT_EQ(cutOf(tree, c, k / 20., splitting).size(), size);
      }
  }
}

TEST(LightTreeSplitting, CutsAreNoLargerThanAllowed) {
  // Contrasts that rounding can't tell from certainty, down the tree.
  Lights steep = makeLights(Kind::Points, 300);
  for (LightId i = 0; i < 300; ++i)
    steep[i].bounds.intensity = std::pow(10.f, static_cast<float>(i % 70) - 35);
  Lights equal = pointLights(std::vector<Vec3>(3, Vec3(0)));
  equal.push_back(equal[0]);
  equal[3].id = 3, equal[3].bounds.intensity = 1e-25f;
  for (const Lights& lights :
       {makeLights(Kind::Points, 5), makeLights(Kind::Cones, 300), steep, equal})
    for (const uint32_t maxCut : {1u, 2u, 3u, 5u, 8u, 17u, 200u}) {
      const WideLightBVH tree{LightBVHAccel(lights)};
      for (uint64_t i = 0; i < 100; ++i) {
        const LightSampleContext c = makeContext(i, lights, 1);
        const SampledLights cut = cutOf(tree, c, random(i, 90), LightSplitting(0.1f, maxCut));
        EXPECT_LE(cut.size(), std::min<size_t>(maxCut, lights.size()));
        std::set<LightId> different;
        for (const SampledLight& s : cut) {
          different.insert(s.light);
          ASSERT_GT(s.pmf, 0);
          ASSERT_LE(s.pmf, 1);
          ASSERT_EQ(s.pmf,
                    tree.expectedCount(LightReceiver(c), s.light, LightSplitting(0.1f, maxCut)));
        }
        EXPECT_EQ(different.size(), cut.size()) << "a light came up twice";
        EXPECT_LE(countOf(tree, c, lights.size(), LightSplitting(0.1f, maxCut)),
                  std::min<double>(maxCut, static_cast<double>(lights.size())) + 1e-3);
      }
    }
}

TEST(LightTreeSplitting, WorthScalesTheBudget) {
  const LightSplitting splitting(0.3f, 20);
  EXPECT_EQ(splitting.forPoint(1).maxCut(), 20u);
  EXPECT_EQ(splitting.forPoint(0.5f).maxCut(), 10u);
  EXPECT_EQ(splitting.forPoint(0.01f).maxCut(), 1u);
}

TEST(LightTreeSplitting, NoLightIsLost) {
  for (const Kind kind : {Kind::Points, Kind::Cones, Kind::TwoSided}) {
    const Lights lights = makeLights(kind, 300);
    const WideLightBVH tree{LightBVHAccel(lights)};
    for (uint64_t i = 0; i < 60; ++i) {
      const LightSampleContext c = makeContext(i, lights, 1);
      for (LightId l = 0; l < 300; ++l) {
        if (tree.pmf(LightReceiver(c), l) > 0) {
          ASSERT_GT(tree.expectedCount(LightReceiver(c), l, LightSplitting(0.2f, 12)), 0);
        }
      }
    }
  }
}

TEST(LightTreeSplitting, StrongLightsAreNotLeftToChance) {
  Lights lights = makeLights(Kind::Points, 1000);
  lights[17].bounds.intensity = 1e5f;
  const WideLightBVH tree{LightBVHAccel(lights)};
  const LightReceiver at(volumeAt(lights[17].bounds.box.min + 0.3f));
  EXPECT_GT(tree.expectedCount(at, 17, LightSplitting(0.1f, 12)), 0.999f);
}

// The thesis's program: one random number for all lights of a cut, so all of them are near their
// clusters' first lights, or all near the last ones.
// A single light can't use more than one of the budget, however strong it is.
TEST(LightTreeSplitting, StrongLightLeavesTheBudgetToOthers) {
  Lights lights = makeLights(Kind::Points, 300);
  lights[0].bounds.box = Bounds3(Vec3(20, 0, 0));
  lights[0].bounds.intensity = 1e4f;
  const WideLightBVH tree{LightBVHAccel(lights)};
  const LightSampleContext c = volumeAt({10, 0, 0});
  const SampledLights cut = cutOf(tree, c, 0.3, LightSplitting(0, 16));
  EXPECT_LE(cut.size(), 16u);
  EXPECT_GE(cut.size(), 10u);
}

TEST(LightTreeSplitting, NumbersOfACutAreStratified) {
  // Eight rods around the point, all alike: whether the light is from the lower half of its rod.
  std::vector<Vec3> positions;
  for (int rod = 0; rod < 8; ++rod)
    for (int i = 0; i < 64; ++i) {
      const float phi = kPi / 4 * static_cast<float>(rod) + 0.3f;
      positions.emplace_back(std::cos(phi), std::sin(phi), (static_cast<float>(i) - 31.5f) / 400);
    }
  const WideLightBVH tree{LightBVHAccel(pointLights(positions))};
  const int n = 2000;
  double sum = 0, squares = 0;
  for (int k = 0; k < n; ++k) {
    const SampledLights cut = cutOf(tree, volumeAt(Vec3(0)), (k + 0.5) / n, LightSplitting(0, 8));
    ASSERT_EQ(cut.size(), 8u);
    double lower = 0;
    for (const SampledLight& s : cut) lower += s.light % 64 < 32;
    sum += lower / n;
    squares += lower * lower / n;
  }
  EXPECT_NEAR(sum, 4, 0.1);
  // Independent numbers: 2. One number for all: 16.
  EXPECT_LT(squares - sum * sum, 1);
}

}  // namespace
}  // namespace lampyris::test
