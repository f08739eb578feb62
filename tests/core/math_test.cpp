// SPDX-License-Identifier: Apache-2.0
#include "core/math.h"

#include <gtest/gtest.h>

#include <limits>

#include "core/bounds.h"
#include "core/hash.h"
#include "core/rgb.h"
#include "core/vector.h"
#include "support/statistics.h"

namespace lampyris {
namespace {

TEST(Math, SafeFunctionsClampWithinRounding) {
  EXPECT_EQ(safeSqrt(-1e-6f), 0.f);
  EXPECT_EQ(safeSqrt(-1e-9), 0.);
  EXPECT_EQ(safeSqrt(0.f), 0.f);
  EXPECT_EQ(safeSqrt(4.f), 2.f);
  EXPECT_EQ(safeSqrt(2.25), 1.5);
  EXPECT_EQ(safeAcos(1.0005f), 0.f);
  EXPECT_FLOAT_EQ(safeAcos(-1.0005f), kPi);
  EXPECT_FLOAT_EQ(safeAcos(0.f), kPi / 2);
  EXPECT_FLOAT_EQ(safeAsin(1.0005f), kPi / 2);
  EXPECT_FLOAT_EQ(safeAsin(-1.0005f), -kPi / 2);
  EXPECT_FLOAT_EQ(safeAsin(0.5f), kPi / 6);
}

TEST(Math, SafeDivideIsFiniteEverywhere) {
  EXPECT_EQ(safeDivide(6, 3), 2.f);
  EXPECT_EQ(safeDivide(1, 0), 0.f);
  EXPECT_EQ(safeDivide(0, 0), 0.f);
  EXPECT_EQ(safeDivide(-1, 0), 0.f);
  EXPECT_EQ(safeDivide(1e30f, 1e-30f), 0.f);
  EXPECT_EQ(safeDivide(kInfinity, kInfinity), 0.f);
  EXPECT_EQ(safeDivide(3, kInfinity), 0.f);
}

TEST(Math, NextFloatsAreAdjacent) {
  for (const float x : {0.f, -0.f, 1.f, -1.f, 1e-40f, 3e38f, -2.5f}) {
    EXPECT_GT(nextFloatUp(x), x);
    EXPECT_LT(nextFloatDown(x), x);
    EXPECT_EQ(nextFloatDown(nextFloatUp(x)), x);
  }
  EXPECT_EQ(nextFloatUp(kInfinity), kInfinity);
  EXPECT_EQ(nextFloatDown(-kInfinity), -kInfinity);
  EXPECT_EQ(nextFloatUp(kOneMinusEpsilon), 1.f);
}

TEST(Math, Constants) {
  EXPECT_LT(kOneMinusEpsilon, 1.f);
  EXPECT_EQ(1.f + kMachineEpsilon, 1.f);
  EXPECT_GT(1.f + 2 * kMachineEpsilon, 1.f);
  EXPECT_GT(roundingBound(3), 3 * kMachineEpsilon);
  EXPECT_LT(roundingBound(3), 3.00001f * kMachineEpsilon);
  EXPECT_EQ(lerp(0, 3, 7), 3.f);
  EXPECT_EQ(lerp(1, 3, 7), 7.f);
  EXPECT_FLOAT_EQ(radians(180), kPi);
  EXPECT_EQ(sqr(-3.f), 9.f);
  EXPECT_EQ(sqr(-3.), 9.);
}

TEST(Vector, NormalizeHasNoScale) {
  for (const float s : {1e-44f, 1e-38f, 1e-30f, 1e-4f, 1.f, 1e4f, 1e30f, 1e38f}) {
    const Vec3 n = normalize(Vec3(2, -1, 2) * s);
    EXPECT_NEAR(length(n), 1, 3e-7) << s;
    if (s >= 1e-38f) {
      EXPECT_NEAR(n.x, 2 / 3.f, 2e-7) << s;
      EXPECT_NEAR(n.y, -1 / 3.f, 2e-7) << s;
    }
  }
  const float max = std::numeric_limits<float>::max();
  EXPECT_NEAR(length(normalize(Vec3(max))), 1, 3e-7);
  EXPECT_NEAR(length(normalize(Vec3(std::numeric_limits<float>::denorm_min(), 0, 0))), 1, 3e-7);
}

TEST(Vector, NormalizeOfNothingIsZero) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  EXPECT_EQ(normalize(Vec3(0)), Vec3(0));
  EXPECT_EQ(normalize(Vec3(kInfinity, 0, 0)), Vec3(0));
  EXPECT_EQ(normalize(Vec3(0, -kInfinity, 1)), Vec3(0));
  for (int i = 0; i < 3; ++i) {
    Vec3 v(1, 2, 3);
    v[i] = nan;
    EXPECT_EQ(normalize(v), Vec3(0)) << i;
    EXPECT_FALSE(isFinite(v));
  }
  EXPECT_TRUE(isFinite(Vec3(1, 2, 3)));
}

TEST(Vector, Helpers) {
  EXPECT_EQ(maxComponent({-3, -1, -2}), -1.f);
  EXPECT_EQ(distance({1, 2, 3}, {1, 5, 7}), 5.f);
  EXPECT_EQ(lengthSquared({1, 2, 3}), 14.f);
  EXPECT_EQ(absDot({1, 0, 0}, {-2, 5, 5}), 2.f);
  EXPECT_EQ(faceForward({0, 0, 1}, {1, 0, -1}), Vec3(0, 0, -1));
  EXPECT_EQ(faceForward({0, 0, 1}, {1, 0, 0}), Vec3(0, 0, 1));
}

TEST(Bounds, EmptyIsNeutral) {
  Bounds3 b;
  EXPECT_TRUE(b.empty());
  EXPECT_EQ(b.extent(), Vec3(0));
  EXPECT_EQ(b.surfaceArea(), 0.f);
  EXPECT_EQ(b.diagonal(), 0.f);
  EXPECT_FALSE(b.contains(Vec3(0)));
  b.extend(Vec3(1, 2, 3));
  EXPECT_FALSE(b.empty());
  EXPECT_EQ(b.min, b.max);
  b.extend(Bounds3());
  EXPECT_EQ(b.max, Vec3(1, 2, 3));
  b.extend(Bounds3({0, 0, 0}, {-1, 5, 0}));
  EXPECT_EQ(b.min, Vec3(-1, 0, 0));
  EXPECT_EQ(b.max, Vec3(1, 5, 3));
  EXPECT_EQ(b.surfaceArea(), 2 * (2 * 5 + 5 * 3 + 3 * 2));
  EXPECT_EQ(b.longestAxis(), 1);
  EXPECT_EQ(b.corner(0), b.min);
  EXPECT_EQ(b.corner(7), b.max);
  EXPECT_EQ(b.corner(2), Vec3(-1, 5, 0));
  EXPECT_EQ(b.centroid(), Vec3(0, 2.5f, 1.5f));
  EXPECT_TRUE(b.contains({1, 5, 3}));
  EXPECT_EQ(Bounds3({0, 0, 0}, {1, 1, 2}).longestAxis(), 2);
  EXPECT_EQ(Bounds3({0, 0, 0}, {1, 1, 1}).longestAxis(), 0);
}

TEST(Bounds, Pixels) {
  const PixelBounds a{{0, 0}, {70000, 70000}}, b{{10, 20}, {5, 30}};
  EXPECT_EQ(a.area(), int64_t{4'900'000'000});
  EXPECT_EQ(b.area(), 0);
  EXPECT_TRUE(a.contains({69999, 0}));
  EXPECT_FALSE(a.contains({70000, 0}));
  EXPECT_FALSE(a.contains({-1, 0}));
  EXPECT_EQ(intersect(a, {{-5, 7}, {9, 8}}), (PixelBounds{{0, 7}, {9, 8}}));
  EXPECT_EQ(intersect({{0, 0}, {2, 2}}, {{5, 5}, {6, 6}}).area(), 0);
}

TEST(Rgb, Arithmetic) {
  const Rgb a(1, 2, 3), b(4, 5, 6);
  EXPECT_EQ(a + b, Rgb(5, 7, 9));
  EXPECT_EQ(b - a, Rgb(3));
  EXPECT_EQ(a * b, Rgb(4, 10, 18));
  EXPECT_EQ(2 * a, a * 2);
  EXPECT_EQ(Rgb(4, 10, 18) / b, a);
  EXPECT_EQ(Rgb(4, 8, 16) / 4, Rgb(1, 2, 4));
  EXPECT_TRUE(Rgb().isBlack());
  EXPECT_FALSE(Rgb(0, 0, -1).isBlack());
  EXPECT_EQ(a.maxComponent(), 3.f);
  EXPECT_FLOAT_EQ(Rgb(1).luminance(), 1.f);
  EXPECT_EQ(clampPositive({-1, 0, 2}), Rgb(0, 0, 2));
  EXPECT_FALSE(Rgb(0, kInfinity, 0).isFinite());
  EXPECT_FALSE(Rgb(0, 0, std::numeric_limits<float>::quiet_NaN()).isFinite());
  EXPECT_EQ(lerp(0.5f, Rgb(0), Rgb(2, 4, 6)), a);
  EXPECT_EQ(sqrt(Rgb(1, 4, 9)), a);
  EXPECT_FLOAT_EQ(exp(Rgb(0, 1, 2)).g, std::exp(1.f));
}

TEST(Hash, FloatsAreBelowOne) {
  EXPECT_EQ(toUnitFloat(~uint64_t{0}), kOneMinusEpsilon);
  EXPECT_EQ(toUnitFloat(~uint32_t{0}), kOneMinusEpsilon);
  EXPECT_EQ(toUnitFloat(uint64_t{0}), 0.f);
}

TEST(Hash, UniformOverSmallInputs) {
  // Neighbouring words are what addresses consist of.
  for (const int shift : {0, 16, 40, 58}) {
    std::vector<double> counts(64), expected(64, 300. * 300 / 64);
    for (uint64_t a = 0; a < 300; ++a)
      for (uint64_t b = 0; b < 300; ++b) ++counts[hashCombine(a, b) >> shift & 63];
    EXPECT_EQ(test::chiSquareTest(counts, expected), "") << shift;
  }
  EXPECT_NE(hashCombine(1, 2), hashCombine(2, 1));
  EXPECT_NE(hashCombine(0, 0), 0u);
}

}  // namespace
}  // namespace lampyris
