// SPDX-License-Identifier: Apache-2.0
#include "core/sampling.h"

#include <gtest/gtest.h>

#include <limits>

#include "core/frame.h"
#include "support/statistics.h"

namespace lampyris {
namespace {

using test::uniform;

Vec2 uniform2(uint64_t i) { return {uniform(7, i, 0), uniform(7, i, 1)}; }

TEST(Sampling, DiskIsUniform) {
  constexpr int kRings = 10, kSectors = 16, kDraws = 200'000;
  std::vector<double> counts(kRings * kSectors),
      expected(counts.size(), kDraws / double{kRings * kSectors});
  for (uint64_t i = 0; i < kDraws; ++i) {
    const Vec2 d = sampleConcentricDisk(uniform2(i));
    const float r2 = dot(d, d);
    ASSERT_LE(r2, 1 + 1e-6f);
    const auto ring = std::min(static_cast<size_t>(r2 * kRings), size_t{kRings - 1});
    const auto sector =
        std::min(static_cast<size_t>(sphericalPhi({d.x, d.y, 0}) / (2 * kPi) * kSectors),
                 size_t{kSectors - 1});
    ++counts[ring * kSectors + sector];
  }
  EXPECT_EQ(test::chiSquareTest(counts, expected), "");
  EXPECT_EQ(sampleConcentricDisk({0.5f, 0.5f}), Vec2(0));
  for (const Vec2& u : {Vec2(0, 0), Vec2(kOneMinusEpsilon, 0), Vec2(0.5f, kOneMinusEpsilon)})
    EXPECT_NEAR(glm::length(sampleConcentricDisk(u)), 1, 1e-5);
}

TEST(Sampling, ExponentialsInvertTheirDistribution) {
  EXPECT_EQ(sampleExponential(0), 0);
  for (const float u : {0x1p-40f, 0x1p-24f, 1e-3f, 0.5f, 0.999f, kOneMinusEpsilon}) {
    const auto exact = static_cast<double>(-std::log1p(-static_cast<long double>(u)));
    // What the logarithm of a double near 1 has lost where it is tiny.
    EXPECT_NEAR(static_cast<double>(sampleExponential(u)), exact, 1e-7 * exact + 2e-16) << u;
  }
}

TEST(Sampling, DirectionsMatchTheirDensities) {
  test::DirectionTest t;
  t.sample = [](const Vec2& u, float, Vec3& w) { return w = sampleCosineHemisphere(u), true; };
  t.pdf = [](const Vec3& w) {
    return w.z > 0 ? static_cast<double>(cosineHemispherePdf(w.z)) : 0.;
  };
  EXPECT_EQ(test::directionChiSquareTest(t), "");
  t.sample = [](const Vec2& u, float, Vec3& w) { return w = sampleUniformSphere(u), true; };
  t.pdf = [](const Vec3&) { return 1 / (4 * M_PI); };
  EXPECT_EQ(test::directionChiSquareTest(t), "");
  for (const float oneMinusCos : {0.3f, 1.f, 1.5f, 2.f}) {
    t.sample = [=](const Vec2& u, float, Vec3& w) {
      return w = sampleUniformCone(u, oneMinusCos), true;
    };
    t.pdf = [=](const Vec3& w) {
      return 1 - w.z <= oneMinusCos ? static_cast<double>(uniformConePdf(oneMinusCos)) : 0.;
    };
    t.subdivisions = 10;  // cell borders on the cone's edge
    EXPECT_EQ(test::directionChiSquareTest(t), "") << oneMinusCos;
  }
}

TEST(Sampling, TinyConesKeepTheirShape) {
  for (const float h : {1e-12f, 1e-8f, 1e-4f}) {
    std::vector<double> counts(100), expected(100, 1000.);
    for (uint64_t i = 0; i < 100'000; ++i) {
      const Vec3 w = sampleUniformCone(uniform2(i), h);
      ASSERT_NEAR(length(w), 1, 1e-6);
      // sin² θ is 2h in first order, and uniform.
      const float at = (w.x * w.x + w.y * w.y) / (2 * h);
      const auto ring = std::min(static_cast<size_t>(at * 10), size_t{9});
      const auto sector =
          std::min(static_cast<size_t>(sphericalPhi(w) / (2 * kPi) * 10), size_t{9});
      ++counts[ring * 10 + sector];
    }
    EXPECT_EQ(test::chiSquareTest(counts, expected), "") << h;
  }
  EXPECT_FLOAT_EQ(uniformConePdf(2), 1 / (4 * kPi));
}

TEST(Sampling, TriangleIsUniform) {
  // Four similar triangles of equal area, twice nested.
  std::vector<double> counts(16), expected(16, 160'000 / 16.);
  for (uint64_t i = 0; i < 160'000; ++i) {
    const Vec2 b = sampleUniformTriangle(uniform2(i));
    ASSERT_GE(b.x, 0);
    ASSERT_GE(b.y, 0);
    ASSERT_LE(b.x + b.y, 1 + 1e-6f);
    Vec3 c(b, 1 - b.x - b.y);
    size_t cell = 0;
    for (int level = 0; level < 2; ++level) {
      size_t part = 3;
      for (int k = 0; k < 3; ++k)
        if (c[k] > 0.5f) part = static_cast<size_t>(k);
      c = part < 3 ? 2.f * c : 1.f - 2.f * c;
      if (part < 3) c[static_cast<int>(part)] -= 1;
      cell = cell * 4 + part;
    }
    ++counts[cell];
  }
  EXPECT_EQ(test::chiSquareTest(counts, expected), "");
}

TEST(Sampling, Heuristics) {
  EXPECT_EQ(balanceHeuristic(0, 0), 0.f);
  EXPECT_EQ(balanceHeuristic(1, 0), 1.f);
  EXPECT_EQ(balanceHeuristic(0, 1), 0.f);
  EXPECT_FLOAT_EQ(balanceHeuristic(1, 3), 0.25f);
  EXPECT_EQ(balanceHeuristic(kInfinity, 1), 1.f);
  EXPECT_EQ(balanceHeuristic(1, kInfinity), 0.f);
  EXPECT_FLOAT_EQ(balanceHeuristic(3e38f, 3e38f), 0.5f);
  EXPECT_FLOAT_EQ(balanceHeuristic(1e-38f, 3e-38f), 0.25f);
  EXPECT_EQ(powerHeuristic(0, 0), 0.f);
  EXPECT_EQ(powerHeuristic(0, 1), 0.f);
  EXPECT_EQ(powerHeuristic(1, 0), 1.f);
  EXPECT_FLOAT_EQ(powerHeuristic(1, 3), 0.1f);
  EXPECT_EQ(powerHeuristic(kInfinity, 1), 1.f);
  EXPECT_EQ(powerHeuristic(1, kInfinity), 0.f);
  EXPECT_FLOAT_EQ(powerHeuristic(3e38f, 3e38f), 0.5f);
  EXPECT_EQ(powerHeuristic(1e-38f, 1e38f), 0.f);
  for (const float p : {1e-20f, 0.3f, 7.f, 1e20f})
    for (const float q : {1e-20f, 0.5f, 1e20f}) {
      EXPECT_NEAR(balanceHeuristic(p, q) + balanceHeuristic(q, p), 1, 1e-6);
      EXPECT_NEAR(powerHeuristic(p, q) + powerHeuristic(q, p), 1, 1e-6);
    }
}

void checkDistribution(const std::vector<float>& values, int draws = 100'000) {
  const Distribution1D d(values);
  std::vector<double> counts(values.size()), expected(values.size());
  double total = 0;
  for (size_t i = 0; i < values.size(); ++i) {
    expected[i] = static_cast<double>(d.pmf(i)) * draws;
    total += static_cast<double>(d.pmf(i));
  }
  EXPECT_NEAR(total, 1, 1e-6);
  for (int i = 0; i < draws; ++i) {
    const auto s = d.sample(uniform(11, static_cast<uint64_t>(i), 0));
    ASSERT_GE(s.x, 0.f);
    ASSERT_LT(s.x, 1.f);
    ASSERT_GT(s.pdf, 0.f);
    ASSERT_EQ(s.pdf, d.pdf(s.x));
    ASSERT_EQ(s.pdf, d.density(s.cell));
    ++counts[s.cell];
  }
  EXPECT_EQ(test::chiSquareTest(counts, expected), "");
  for (const float u : {0.f, kOneMinusEpsilon}) EXPECT_GT(d.sample(u).pdf, 0.f);
}

TEST(Distribution1D, FrequenciesMatchTheDensity) {
  checkDistribution({1, 2, 3, 4});
  checkDistribution({0, 0, 5, 0, 1, 0, 0});
  checkDistribution({0, 1});
  checkDistribution({1, 0});
  checkDistribution({7});
  checkDistribution({1e-30f, 2e-30f, 0});
  checkDistribution({3e38f, 3e38f, 1e38f});
  checkDistribution({1, 1e-12f, 1e12f, 3});
  std::vector<float> many(5000);
  for (size_t i = 0; i < many.size(); ++i) many[i] = i % 3 == 0 ? 0.f : uniform(2, i, 0);
  checkDistribution(many);
}

TEST(Distribution1D, AllZeroIsUniform) {
  checkDistribution({0, 0, 0, 0});
  const Distribution1D d(std::vector<float>{0, 0, 0, 0});
  EXPECT_EQ(d.integral(), 0.);
  EXPECT_FLOAT_EQ(d.pmf(2), 0.25f);
}

TEST(Distribution1D, InvalidValuesCountAsZero) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const Distribution1D d(std::vector<float>{nan, -3, 2, kInfinity, 6});
  EXPECT_EQ(d.pmf(0), 0.f);
  EXPECT_EQ(d.pmf(1), 0.f);
  EXPECT_EQ(d.pmf(3), 0.f);
  EXPECT_FLOAT_EQ(d.pmf(2), 0.25f);
  EXPECT_DOUBLE_EQ(d.integral(), 8 / 5.);
}

TEST(Distribution1D, PdfOutsideIsThatOfTheEnds) {
  const Distribution1D d(std::vector<float>{1, 3});
  EXPECT_EQ(d.pdf(-1), d.density(0));
  EXPECT_EQ(d.pdf(1), d.density(1));
}

void checkDistribution2D(const std::vector<float>& values, int width, int height) {
  const Distribution2D d(values, width, height);
  constexpr int kDraws = 200'000;
  std::vector<double> counts(values.size()), expected(values.size());
  const auto cell = [&](const Vec2& p) {
    const auto x = static_cast<size_t>(p.x * static_cast<float>(width));
    const auto y = static_cast<size_t>(p.y * static_cast<float>(height));
    return y * static_cast<size_t>(width) + x;
  };
  double total = 0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const Vec2 p((static_cast<float>(x) + 0.5f) / static_cast<float>(width),
                   (static_cast<float>(y) + 0.5f) / static_cast<float>(height));
      const double share = static_cast<double>(d.pdf(p)) / (width * height);
      expected[cell(p)] = share * kDraws;
      total += share;
    }
  EXPECT_NEAR(total, 1, 1e-5);
  for (uint64_t i = 0; i < kDraws; ++i) {
    const auto s = d.sample(uniform2(i));
    ASSERT_TRUE(s.p.x >= 0 && s.p.x < 1 && s.p.y >= 0 && s.p.y < 1);
    ASSERT_GT(s.pdf, 0.f);
    ASSERT_EQ(s.pdf, d.pdf(s.p));
    ++counts[cell(s.p)];
  }
  EXPECT_EQ(test::chiSquareTest(counts, expected), "");
}

TEST(Distribution2D, FrequenciesMatchTheDensity) {
  checkDistribution2D({1, 2, 3, 4, 5, 6}, 3, 2);
  checkDistribution2D({0, 0, 0, 0, 5, 0, 1, 0, 0}, 3, 3);
  checkDistribution2D({0, 0, 0, 0}, 2, 2);
  checkDistribution2D({1}, 1, 1);
  std::vector<float> values(16 * 8);
  for (size_t i = 0; i < values.size(); ++i) values[i] = i == 77 ? 1000.f : uniform(3, i, 1);
  checkDistribution2D(values, 16, 8);
}

TEST(Distribution2D, IntegralIsTheMean) {
  const Distribution2D d(std::vector<float>{1, 2, 3, 6}, 2, 2);
  EXPECT_DOUBLE_EQ(d.integral(), 3);
  EXPECT_FLOAT_EQ(d.pdf({0.75f, 0.75f}), 2);
}

}  // namespace
}  // namespace lampyris
