// SPDX-License-Identifier: Apache-2.0
/// The contract of light distributions, for both forms of the light BVH.
#include <cstring>

#include "core/parallel.h"
#include "light_trees.h"

namespace lampyris::test {
namespace {

TYPED_TEST_SUITE(LightTree, LightTreeForms);

TYPED_TEST(LightTree, DropsLightsThatCannotCount) {
  auto lights = makeLights(Kind::Points, 8);
  lights[1].bounds.intensity = 0;
  lights[2].bounds.intensity = std::nanf("");
  lights[3].bounds.intensity = kInfinity;
  lights[4].bounds.box = Bounds3();
  lights[5].bounds.box = Bounds3(Vec3(std::nanf("")));
  lights[6].bounds.box.max.x = kInfinity;
  const TypeParam tree = TestFixture::build(lights);
  EXPECT_EQ(tree.stats().lights, 2u);
  LightSampleContext ctx;
  for (LightId i = 1; i < 7; ++i) EXPECT_EQ(tree.pmf(LightReceiver(ctx), i), 0);
  EXPECT_NEAR(tree.pmf(LightReceiver(ctx), 0) + tree.pmf(LightReceiver(ctx), 7), 1, 1e-6);
  EXPECT_EQ(tree.pmf(LightReceiver(ctx), kNoLight), 0);
  const TypeParam none = TestFixture::build(Lights(lights.begin() + 1, lights.begin() + 7));
  EXPECT_TRUE(none.empty());
  EXPECT_FALSE(none.sample(LightReceiver(ctx), 0.5f));
  EXPECT_EQ(none.pmf(LightReceiver(ctx), 1), 0);
  EXPECT_EQ(none.rootImportance(LightReceiver(ctx)), 0);
  EXPECT_TRUE(TestFixture::build({}).empty());
}

TYPED_TEST(LightTree, MissesNoLight) {
  for (const Kind kind : {Kind::Points, Kind::Line, Kind::Cones, Kind::TwoSided, Kind::FewCones})
    for (const float scale : {1e-4f, 1.f, 1e4f}) {
      const auto lights = makeLights(kind, 200, scale);
      const TypeParam tree = TestFixture::build(lights);
      for (uint64_t i = 0; i < 60; ++i) {
        const LightSampleContext c = makeContext(i, lights, scale);
        double sum = 0;
        for (const LightBVHInput& l : lights) {
          const float pmf = tree.pmf(LightReceiver(c), l.id);
          ASSERT_TRUE(pmf >= 0 && pmf <= 1);
          sum += static_cast<double>(pmf);
          const Vec3 e = l.bounds.box.extent();
          const Vec3 source = l.bounds.box.min + randomPoint(i * 1000 + l.id, 70) * e;
          if (source == c.p || !permitted(c, normalize(source - c.p))) continue;
          if (emitsTo(l.bounds, source, c.p)) {
            EXPECT_GT(pmf, 0);
          }
        }
        EXPECT_LE(sum, 1 + 1e-4);
        if (kind == Kind::Points && c.reflects && c.transmits) {
          EXPECT_NEAR(sum, 1, 1e-4);
        }
      }
    }
}

TYPED_TEST(LightTree, ExtremeIntensitiesAndDistances) {
  auto lights = makeLights(Kind::Points, 64);
  for (size_t i = 0; i < lights.size(); ++i) lights[i].bounds.intensity = i % 2 ? 1e12f : 1e-12f;
  const TypeParam tree = TestFixture::build(lights);
  for (const float far : {0.f, 1e-20f, 1e-3f, 1e6f, 1e15f}) {
    LightSampleContext c;
    c.p = lights[3].bounds.box.min + Vec3(far, 0, 0);
    double sum = 0;
    for (LightId l = 0; l < 64; ++l) {
      if (c.p != lights[l].bounds.box.min) {
        EXPECT_GT(tree.pmf(LightReceiver(c), l), 0);
      }
      sum += static_cast<double>(tree.pmf(LightReceiver(c), l));
    }
    EXPECT_NEAR(sum, 1, 1e-5);
    EXPECT_TRUE(std::isfinite(tree.rootImportance(LightReceiver(c))));
  }
}

TYPED_TEST(LightTree, DrawsAsPmfSays) {
  const auto lights = makeLights(Kind::Cones, 400);
  const TypeParam tree = TestFixture::build(lights);
  for (uint64_t i = 0; i < 6; ++i) {
    const LightSampleContext c = makeContext(i, lights, 1);
    std::vector<double> observed(401, 0.), expected(401, 0.);
    const int n = 40'000;
    expected[400] = n;
    for (LightId l = 0; l < 400; ++l) {
      expected[l] = n * static_cast<double>(tree.pmf(LightReceiver(c), l));
      expected[400] -= expected[l];
    }
    expected[400] = std::max(expected[400], 0.);
    for (int k = 0; k < n; ++k) {
      const auto s = tree.sample(LightReceiver(c), uniform(77, static_cast<uint64_t>(k), 3));
      ++observed[s ? s->light : 400];
      if (s) {
        ASSERT_EQ(s->pmf, tree.pmf(LightReceiver(c), s->light));
      }
    }
    EXPECT_EQ(chiSquareTest(observed, expected), "");
  }
}

TYPED_TEST(LightTree, SameForAnyNumberOfThreads) {
  for (const Kind kind : {Kind::Points, Kind::Cones}) {
    const auto lights = makeLights(kind, 50'000);
    const auto build = [&](int threads) {
      const ThreadLimit limit(threads);
      return TestFixture::build(lights);
    };
    const TypeParam one = build(1), four = build(4);
    ASSERT_EQ(one.nodes().size(), four.nodes().size());
    EXPECT_EQ(std::memcmp(one.nodes().data(), four.nodes().data(),
                          one.nodes().size() * sizeof one.nodes()[0]),
              0);
  }
}

TYPED_TEST(LightTree, DrawsEveryLightOfALargeTree) {
  const auto lights = makeLights(Kind::Coincident, 1 << 20);
  const TypeParam tree = TestFixture::build(lights);
  LightSampleContext c;
  c.p = Vec3(5);
  const size_t cells = 64;
  const int n = 100'000;
  std::vector<double> observed(cells, 0.), exact(cells, 0.);
  double total = 0;
  for (const auto& l : lights) total += static_cast<double>(l.bounds.intensity);
  for (const auto& l : lights)
    exact[l.id % cells] += static_cast<double>(l.bounds.intensity) / total * n;
  for (int k = 0; k < n; ++k) {
    const auto s = tree.sample(LightReceiver(c), uniform(78, static_cast<uint64_t>(k), 3));
    ASSERT_TRUE(s);
    ++observed[s->light % cells];
  }
  EXPECT_EQ(chiSquareTest(observed, exact), "");
}

}  // namespace
}  // namespace lampyris::test
