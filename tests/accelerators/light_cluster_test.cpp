// SPDX-License-Identifier: Apache-2.0
/// Clusters of the wide light BVH whose lights are drawn by intensity alone.
#include <algorithm>

#include "light_trees.h"

namespace lampyris::test {
namespace {

constexpr size_t kLights = 2000;

void expectDrawsAsPmfSays(const Lights& lights) {
  const WideLightBVH tree{LightBVHAccel(lights)};
  for (const auto& c :
       {volumeAt({9, 3, 2}), opaqueAt({-7, 1, 3}, normalize(Vec3(4, 1, 1))), volumeAt({2, 1, 1})}) {
    const LightReceiver at(c);
    const auto all = pmfs(tree, c, lights.size());
    EXPECT_NEAR(sumOf(all), 1, 1e-5);
    const int n = 100'000;
    std::vector<double> observed(lights.size(), 0.), expected(lights.size());
    for (size_t l = 0; l < lights.size(); ++l) expected[l] = n * all[l];
    for (int k = 0; k < n; ++k) {
      const auto s = tree.sample(at, uniform(79, static_cast<uint64_t>(k), 3));
      ASSERT_TRUE(s);
      ASSERT_EQ(s->pmf, tree.pmf(at, s->light));
      ++observed[s->light];
    }
    EXPECT_EQ(chiSquareTest(observed, expected), "");
  }
}

TEST(LightClusters, DrawAsPmfSays) { expectDrawsAsPmfSays(makeLights(Kind::Points, kLights)); }

// First all of them, then those of one half.
TEST(LightClusters, OfLightsAboutAsStrongDrawAsPmfSays) {
  Lights lights = makeLights(Kind::Points, 5 * kLights);
  for (LightBVHInput& l : lights) l.bounds.intensity = 1 + 0.03f * random(l.id, 9);
  expectDrawsAsPmfSays(lights);
  for (LightBVHInput& l : lights)
    if (l.bounds.box.min.x > 0.5f) l.bounds.intensity = 0.1f + random(l.id, 9);
  expectDrawsAsPmfSays(lights);
}

TEST(LightClusters, OfEvenLightsAreDrawnFromAlike) {
  Lights lights = makeLights(Kind::Points, 10 * kLights);
  for (LightBVHInput& l : lights) l.bounds.intensity = 1;
  const WideLightBVH tree{LightBVHAccel(lights)};
  std::vector<double> all = pmfs(tree, volumeAt({40, 3, 2}), lights.size());
  std::sort(all.begin(), all.end());
  // Those of a child of the root, at most eight different ones.
  EXPECT_LE(std::unique(all.begin(), all.end()) - all.begin(), 8);
}

TEST(LightClusters, DrawFaintLightsBesideAStrongOne) {
  auto lights = makeLights(Kind::Points, kLights);
  for (LightBVHInput& l : lights) l.bounds.intensity = l.id % 2 == 0 ? 1e-6f : 3e-6f;
  lights[77].bounds.intensity = 1e6f;
  const WideLightBVH tree{LightBVHAccel(lights)};
  const auto all = pmfs(tree, volumeAt(Vec3(30)), kLights);
  EXPECT_NEAR(sumOf(all), 1, 1e-5);
  EXPECT_GT(all[77], 0.99);
  for (const double pmf : all) EXPECT_GT(pmf, 0);
}

TEST(LightClusters, OfEmittersThatFaceAllWaysLookAtEach) {
  const auto lights = makeLights(Kind::Cones, kLights);
  const WideLightBVH tree{LightBVHAccel(lights)};
  const LightSampleContext c = volumeAt({40, 3, 2});
  size_t none = 0;
  for (const double pmf : pmfs(tree, c, kLights)) none += pmf == 0;
  EXPECT_GT(none, kLights / 10);
}

}  // namespace
}  // namespace lampyris::test
