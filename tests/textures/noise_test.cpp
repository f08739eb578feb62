// SPDX-License-Identifier: Apache-2.0
#include "textures/noise.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "support/statistics.h"
#include "textures/perlin_permutation.h"
#include "textures/texture_test_support.h"

namespace lampyris::test {
namespace {

Vec3 randomPoint(uint64_t i, float size) {
  return size * (2.f * Vec3(uniform(1, i, 0), uniform(1, i, 1), uniform(1, i, 2)) - 1.f);
}

TEST(Noise, TheTableIsAPermutation) {
  auto sorted = kPerlinPermutation;
  std::sort(sorted.begin(), sorted.end());
  for (size_t i = 0; i < 256; ++i) EXPECT_EQ(sorted[i], i);
}

TEST(Noise, IsZeroOnTheLatticeAndPeriodic) {
  for (uint64_t i = 0; i < 200; ++i) {
    EXPECT_EQ(perlinNoise(glm::floor(randomPoint(i, 500))), 0);
    const Vec3 p = glm::floor(randomPoint(i, 100) * 64.f) / 64.f;  // so that adding is exact
    EXPECT_EQ(perlinNoise(p + Vec3(256, -512, 256)), perlinNoise(p));
  }
}

TEST(Noise, IsSmoothBoundedAndBalanced) {
  std::vector<double> values;
  for (uint64_t i = 0; i < 20000; ++i) {
    const Vec3 p = randomPoint(i, 100);
    const float n = perlinNoise(p);
    EXPECT_LE(std::abs(n), 1);
    values.push_back(static_cast<double>(n));
    // Its slope is at most about 3; across the cells' faces, too.
    const Vec3 edge(std::floor(p.x), p.y, p.z);
    EXPECT_NEAR(perlinNoise(edge - Vec3(1e-3f, 0, 0)), perlinNoise(edge + Vec3(1e-3f, 0, 0)),
                8e-3f);
  }
  EXPECT_EQ(meanTest(values, 0, 0.01), "");
}

TEST(Noise, HasTheValuesOfItsGradients) {
  // In the middle of a cell all corners weigh the same: the mean of g · d. Corner hashes 0…: the
  // gradients of cell (0, 0, 0) by hand from the table.
  const auto p = [](uint32_t i) { return static_cast<uint32_t>(kPerlinPermutation[i & 255]); };
  double sum = 0;
  for (uint32_t c = 0; c < 8; ++c) {
    const uint32_t x = c & 1, y = c >> 1 & 1, z = c >> 2;
    const uint32_t h = p(p(p(x) + y) + z) & 15;
    const double dx = 0.5 - x, dy = 0.5 - y, dz = 0.5 - z;
    const double u = h < 8 || h == 12 || h == 13 ? dx : dy;
    const double v = h < 4 || h == 12 || h == 13 ? dy : dz;
    sum += (h & 1 ? -u : u) + (h & 2 ? -v : v);
  }
  EXPECT_NEAR(perlinNoise(Vec3(0.5f)), sum / 8, 1e-6);
}

TEST(Noise, AnyPositionIsHarmless) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
  for (const float x : {kNan, kInfinity, -kInfinity, 3e38f, -1e20f, 1e-40f})
    for (const Vec3 p : {Vec3(x, 0.3f, 0.2f), Vec3(0.3f, x, 0.2f), Vec3(x)}) {
      EXPECT_TRUE(std::isfinite(perlinNoise(p)));
      EXPECT_TRUE(std::isfinite(fractalNoise({p, p, p}, {128, 0.5f})));
      EXPECT_TRUE(std::isfinite(turbulence({p, Vec3(0), p}, {128, 0.5f})));
    }
}

TEST(Noise, FootprintsRemoveOctaves) {
  const Vec3 p(3.2f, -1.7f, 0.4f);
  const TexturePoint sharp{p, {}, {}};
  EXPECT_EQ(fractalNoise(sharp, {0, 0.5f}), 0);
  float sum = 0;
  for (int i = 0; i < 3; ++i)
    sum += static_cast<float>(std::pow(0.7, i)) *
           perlinNoise(static_cast<float>(std::pow(1.99, i)) * p);
  EXPECT_NEAR(fractalNoise(sharp, {3, 0.7f}), sum, 1e-4f);
  // log2 of the width 1/16 leaves 4 − 1 octaves; wide ones none.
  EXPECT_NEAR(fractalNoise({p, {1.f / 16, 0, 0}, {0, 1.f / 32, 0}}, {8, 0.7f}), sum, 1e-4f);
  EXPECT_EQ(fractalNoise({p, {5, 0, 0}, {}}, {8, 0.7f}), 0);
  // Turbulence goes to the mean of what is left out: 0.2 (1 + 1 + r + r²).
  EXPECT_NEAR(turbulence({p, {5, 0, 0}, {}}, {3, 0.5f}), 0.2f * (1 + 1.75f), 1e-6f);
}

TEST(NoiseTextures, ScaleWithTheirTransform) {
  TextureBench bench;
  bench.textureToWorld = Transform::scale(Vec3(2));
  const SurfaceInteraction at = atPoint({0.3f, 0.7f, -0.2f});
  const TexturePoint p{2.f * at.p, {}, {}};
  EXPECT_EQ(bench.makeFloat("fbm")->evaluate(at), fractalNoise(p, {}));
  EXPECT_EQ(
      bench.makeFloat("wrinkled", Parameters().integer("octaves", 3).number("roughness", 0.6f))
          ->evaluate(at),
      turbulence(p, {3, 0.6f}));
  EXPECT_EQ(bench.makeSpectrum("windy")->evaluate(at),
            Rgb(std::abs(fractalNoise(p * 0.1f, {3, 0.5f})) * fractalNoise(p, {6, 0.5f})));
  EXPECT_THROW(bench.makeFloat("fbm", Parameters().integer("octaves", 1000000000)), SceneError);
  EXPECT_THROW(bench.makeFloat("fbm", Parameters().integer("octaves", -1)), SceneError);
}

TEST(NoiseTextures, MarbleRunsAlongItsSpline) {
  TextureBench bench;
  const auto marble =
      bench.makeSpectrum("marble", Parameters().number("variation", 0).number("scale", 2));
  // Where the sine is −1 the spline begins, at its sixth the second segment does.
  const Rgb begin = marble->evaluate(atPoint({9, -kPi / 4, 3}));
  EXPECT_NEAR(begin.r, 1.5f * 0.58f, 1e-4f);
  EXPECT_NEAR(begin.b, 1.5f * 0.6f, 1e-4f);
  const float y = std::asin(-1 + 1.9999f / 6) / 2;
  EXPECT_NEAR(marble->evaluate(atPoint({0, y, 0})).r, 1.5f * 0.5f, 1e-3f);
  for (uint64_t i = 0; i < 100; ++i)
    EXPECT_TRUE(marble->evaluate(atPoint(randomPoint(i, 1e30f))).isFinite());
}

TEST(NoiseTextures, DotsLieInTheirCells) {
  TextureBench bench;
  const auto dots = bench.makeFloat("dots");
  int filled = 0, dotted = 0;
  constexpr int kCells = 40, kSteps = 16;
  for (int j = 0; j < kCells; ++j)
    for (int i = 0; i < kCells; ++i) {
      int inside = 0;
      for (int k = 0; k < kSteps * kSteps; ++k) {
        const Vec2 offset((static_cast<float>(k % kSteps) + 0.5f) / kSteps - 0.5f,
                          (static_cast<float>(k / kSteps) + 0.5f) / kSteps - 0.5f);
        inside += dots->evaluate(atUv(static_cast<float>(i) + offset.x,
                                      static_cast<float>(j) + offset.y)) == 0;
      }
      filled += inside;
      dotted += inside > 0;
    }
  EXPECT_NEAR(static_cast<double>(dotted) / (kCells * kCells), 0.4, 0.1);
  // A dot, which has the value of "outside", is never cut off.
  EXPECT_NEAR(static_cast<double>(filled) / (dotted * kSteps * kSteps), M_PI * 0.35 * 0.35, 0.01);
}

}  // namespace
}  // namespace lampyris::test
