// SPDX-License-Identifier: Apache-2.0
// What every registered sampler must hold.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "core/math.h"
#include "samplers/registry.h"
#include "support/statistics.h"

namespace lampyris {
namespace {

std::unique_ptr<Sampler> make(const std::string& name, int spp = 16, uint64_t seed = 0) {
  SamplerContext context;
  context.samplesPerPixel = spp;
  context.seed = seed;
  return samplerRegistry().get(name, {}).create({}, context);
}

class EverySampler : public testing::TestWithParam<std::string> {};

INSTANTIATE_TEST_SUITE_P(Samplers, EverySampler, testing::ValuesIn(samplerRegistry().names()),
                         [](const auto& param) { return param.param; });

TEST_P(EverySampler, NumbersAreBelowOneAndFine) {
  for (const int spp : {1, 3, 16, 1000}) {
    const auto s = make(GetParam(), spp);
    int fine = 0;
    for (int i = 0; i < 3000; ++i) {
      const SampleAddress a{{i % 37, i % 1013}, static_cast<uint64_t>(i)};
      const Vec2 u = s->get2D(a, static_cast<uint32_t>(i % 50));
      for (const float v : {u.x, u.y, s->get1D(a, static_cast<uint32_t>(i))}) {
        ASSERT_GE(v, 0.f);
        ASSERT_LT(v, 1.f);
        // More than 16 bits of resolution.
        fine += std::fmod(v * 65536, 1.f) != 0;
      }
    }
    EXPECT_GT(fine, 8000) << spp;
  }
}

TEST_P(EverySampler, IsAPureFunction) {
  const auto s = make(GetParam()), same = make(GetParam());
  std::vector<float> forth;
  for (int i = 0; i < 500; ++i)
    forth.push_back(s->get1D({{i % 7, i % 11}, static_cast<uint64_t>(i)}, 3));
  for (int i = 499; i >= 0; --i) {
    const SampleAddress a{{i % 7, i % 11}, static_cast<uint64_t>(i)};
    s->get2D({{i, 2}, 5}, 8);
    EXPECT_EQ(s->get1D(a, 3), forth[static_cast<size_t>(i)]);
    EXPECT_EQ(same->get1D(a, 3), forth[static_cast<size_t>(i)]);
  }
}

/// The plan covers `spp` samples in many pixels; what is drawn is uniform over pixels.
TEST_P(EverySampler, EachIndexIsUniformOverPixels) {
  for (const uint64_t index :
       {uint64_t{0}, uint64_t{7}, uint64_t{15}, uint64_t{100}, uint64_t{1} << 33}) {
    const auto s = make(GetParam());
    std::vector<double> counts(64), expected(64, 20'000 / 64.), line(32),
        lineExpected(32, 20'000 / 32.);
    for (int i = 0; i < 20'000; ++i) {
      // Pixels of far-apart tiles: within a tile they are stratified, and χ² too small.
      const SampleAddress a{{(i % 141) * 1000 + i % 13, (i / 141) * 777}, index};
      const Vec2 u = s->get2D(a, 4);
      ++counts[static_cast<size_t>(u.x * 8) * 8 + static_cast<size_t>(u.y * 8)];
      ++line[static_cast<size_t>(s->get1D(a, 6) * 32)];
    }
    EXPECT_EQ(test::chiSquareTest(counts, expected), "") << index;
    EXPECT_EQ(test::chiSquareTest(line, lineExpected), "") << index;
  }
}

TEST_P(EverySampler, EachDimensionIsUniformInAPixel) {
  const auto s = make(GetParam(), 4096);
  for (uint32_t d = 0; d < 40; ++d) {
    std::vector<double> counts(32), expected(32, 128);
    for (uint64_t i = 0; i < 4096; ++i)
      ++counts[static_cast<size_t>(s->get1D({{3, 5}, i}, d) * 32)];
    EXPECT_EQ(test::chiSquareTest(counts, expected), "") << d;
  }
}

double correlation(const std::function<Vec2(uint64_t)>& draw, uint64_t count) {
  double xy = 0, xx = 0, yy = 0;
  for (uint64_t i = 0; i < count; ++i) {
    const Vec2 u = draw(i);
    const double x = static_cast<double>(u.x) - 0.5, y = static_cast<double>(u.y) - 0.5;
    xy += x * y, xx += x * x, yy += y * y;
  }
  return xy / std::sqrt(xx * yy);
}

/// |r| √n of independent draws is below 6.2 but for 1e-9.
constexpr double kMaxDeviation = 6.2;

TEST_P(EverySampler, DimensionsAndPixelsAreIndependent) {
  const auto s = make(GetParam(), 64);
  constexpr uint64_t kCount = 4096;
  const double limit = kMaxDeviation / std::sqrt(double{kCount});
  for (uint32_t d = 0; d < 12; ++d) {
    // Neighbouring dimensions, over samples of many pixels.
    EXPECT_LT(std::abs(correlation(
                  [&](uint64_t i) {
                    const SampleAddress a{{static_cast<int>(i / 64), 9}, i % 64};
                    return Vec2(s->get1D(a, d), s->get1D(a, d + 1));
                  },
                  kCount)),
              limit)
        << d;
    // Pairs, across.
    EXPECT_LT(std::abs(correlation(
                  [&](uint64_t i) {
                    const SampleAddress a{{static_cast<int>(i / 64), 9}, i % 64};
                    return Vec2(s->get2D(a, d).x, s->get2D(a, d + 2).y);
                  },
                  kCount)),
              limit)
        << d;
    // The two numbers of a pair.
    EXPECT_LT(std::abs(correlation(
                  [&](uint64_t i) {
                    return s->get2D({{static_cast<int>(i / 64), 9}, i % 64}, d);
                  },
                  kCount)),
              limit)
        << d;
  }
}

TEST_P(EverySampler, CellsOfTwoDimensionsAreIndependent) {
  // Finer than a correlation: 1D numbers of two dimensions on a grid, over many pixels.
  const auto s = make(GetParam(), 16);
  std::vector<double> counts(256), expected(256, 64'000 / 256.);
  for (uint64_t i = 0; i < 64'000; ++i) {
    const SampleAddress a{{static_cast<int>(i / 16) * 300, 1}, i % 16};
    ++counts[static_cast<size_t>(s->get1D(a, 2) * 16) * 16 +
             static_cast<size_t>(s->get1D(a, 5) * 16)];
  }
  EXPECT_EQ(test::chiSquareTest(counts, expected), "");
}

TEST_P(EverySampler, DistantPixelsAndSeedsDiffer) {
  const auto a = make(GetParam(), 64, 1), b = make(GetParam(), 64, 2);
  constexpr uint64_t kCount = 4096;
  const double limit = kMaxDeviation / std::sqrt(double{kCount});
  const auto at = [](uint64_t i, int y) {
    return SampleAddress{{static_cast<int>(i / 64) * 3, y}, i % 64};
  };
  EXPECT_LT(std::abs(correlation(
                [&](uint64_t i) { return Vec2(a->get1D(at(i, 0), 0), a->get1D(at(i, 5000), 0)); },
                kCount)),
            limit);
  EXPECT_LT(
      std::abs(correlation(
          [&](uint64_t i) { return Vec2(a->get1D(at(i, 7), 0), b->get1D(at(i, 7), 0)); }, kCount)),
      limit);
  int equal = 0;
  for (uint64_t i = 0; i < 1000; ++i) equal += a->get2D(at(i, 3), 0) == b->get2D(at(i, 3), 0);
  EXPECT_EQ(equal, 0);
}

/// Root mean square error of integrals by `spp` samples, starting at index `first`.
double integrationError(const Sampler& s, uint64_t first, uint64_t spp,
                        const std::function<double(Vec2)>& f, double exact) {
  double sum = 0;
  constexpr int kPixels = 400;
  for (int p = 0; p < kPixels; ++p) {
    double mean = 0;
    for (uint64_t i = 0; i < spp; ++i)
      mean += f(s.get2D({{p * 331, p * 7}, first + i}, 2)) / static_cast<double>(spp);
    sum += (mean - exact) * (mean - exact);
  }
  return std::sqrt(sum / kPixels);
}

TEST_P(EverySampler, IntegratesBetterThanRandom) {
  if (GetParam() == "random") GTEST_SKIP();
  const auto smooth = [](Vec2 u) { return static_cast<double>(u.x * u.y); };
  const auto edge = [](Vec2 u) { return u.x + 0.4f * u.y < 0.7f ? 1. : 0.; };
  const double discArea = M_PI / 4;
  const auto disc = [](Vec2 u) { return dot(u, u) < 1 ? 1. : 0.; };
  for (const int spp : {16, 64}) {
    const auto s = make(GetParam(), spp), random = make("random", spp);
    const auto n = static_cast<uint64_t>(spp);
    EXPECT_LT(integrationError(*s, 0, n, smooth, 0.25),
              0.4 * integrationError(*random, 0, n, smooth, 0.25));
    EXPECT_LT(integrationError(*s, 0, n, edge, 0.5),
              0.6 * integrationError(*random, 0, n, edge, 0.5));
    EXPECT_LT(integrationError(*s, 0, n, disc, discArea),
              0.65 * integrationError(*random, 0, n, disc, discArea));
    // Beyond the plan, too.
    EXPECT_LT(integrationError(*s, n, n, smooth, 0.25),
              0.4 * integrationError(*random, n, n, smooth, 0.25));
    EXPECT_LT(integrationError(*s, 0, 8 * n, smooth, 0.25),
              0.4 * integrationError(*random, 0, 8 * n, smooth, 0.25));
  }
}

TEST_P(EverySampler, AnyCountWorks) {
  for (const int spp : {1, 2, 5, 12, 100, 1 << 20, 1 << 30}) {
    const auto s = make(GetParam(), spp);
    EXPECT_EQ(s->samplesPerPixel(), spp);
    for (const uint64_t i :
         {uint64_t{0}, uint64_t{1}, uint64_t{1} << 31, uint64_t{1} << 40, ~uint64_t{0} >> 8}) {
      const Vec2 u = s->get2D({{1 << 20, 3}, i}, 1'000'000);
      EXPECT_TRUE(u.x >= 0 && u.x < 1 && u.y >= 0 && u.y < 1);
      const float v = s->get1D({{-3, -1}, i}, ~0u);
      EXPECT_TRUE(v >= 0 && v < 1);
    }
  }
  // Not a power of two: the mean stays that of a uniform number.
  const auto s = make(GetParam(), 12);
  std::vector<double> values;
  for (int i = 0; i < 24'000; ++i)
    values.push_back(
        static_cast<double>(s->get1D({{i / 12 * 300, 0}, static_cast<uint64_t>(i % 12)}, 0)));
  EXPECT_EQ(test::meanTest(values, 0.5), "");
}

TEST(Samplers, CountsComeFromTheSceneUnlessOverridden) {
  const int32_t nine[] = {9};
  Parameter p;
  p.name = "pixelsamples";
  p.type = ParameterType::Integer;
  p.integers = nine;
  SamplerContext context;
  for (const char* name : {"random", "halton", "sobol", "02sequence", "maxmindist", "bluenoise"}) {
    const auto& entry = samplerRegistry().get(name, {});
    EXPECT_EQ(entry.create({}, context)->samplesPerPixel(), 16) << name;
    EXPECT_EQ(entry.create({{&p, 1}, {}}, context)->samplesPerPixel(), 9) << name;
  }
  EXPECT_EQ(samplerRegistry().get("stratified", {}).create({}, context)->samplesPerPixel(), 16);
  context.samplesPerPixel = 5;
  for (const auto& entry : samplerRegistry().entries())
    EXPECT_EQ(entry.create({}, context)->samplesPerPixel(), 5) << entry.name;
  EXPECT_TRUE(samplerRegistry().find("lowdiscrepancy"));
  EXPECT_TRUE(samplerRegistry().get("halton", {}).schema.find("samplepixelcenter"));
}

TEST(Samplers, StratifiedFillsEveryStratum) {
  SamplerContext context;
  const int32_t six[] = {6}, five[] = {5};
  Parameter p[2];
  p[0].name = "xsamples", p[1].name = "ysamples";
  p[0].integers = six, p[1].integers = five;
  p[0].type = p[1].type = ParameterType::Integer;
  const auto s = samplerRegistry().get("stratified", {}).create({p, {}}, context);
  ASSERT_EQ(s->samplesPerPixel(), 30);
  std::vector<int> orders;
  for (const uint64_t block : {uint64_t{0}, uint64_t{1}, uint64_t{77}}) {
    std::vector<int> cells(30), strata(30);
    for (uint64_t i = 0; i < 30; ++i) {
      const SampleAddress a{{4, 5}, block * 30 + i};
      const Vec2 u = s->get2D(a, 10);
      ++cells[static_cast<size_t>(u.x * 6) * 5 + static_cast<size_t>(u.y * 5)];
      const auto stratum = static_cast<size_t>(s->get1D(a, 11) * 30);
      ++strata[stratum];
      orders.push_back(static_cast<int>(stratum));
    }
    EXPECT_EQ(cells, std::vector<int>(30, 1));
    EXPECT_EQ(strata, std::vector<int>(30, 1));
  }
  EXPECT_FALSE(std::equal(orders.begin(), orders.begin() + 30, orders.begin() + 30));
}

TEST(Samplers, StratifiedWithoutJitterTakesCentres) {
  const std::string_view no[] = {"false"};
  Parameter p;
  p.name = "jitter";
  p.type = ParameterType::Bool;
  p.strings = no;
  const auto s = samplerRegistry().get("stratified", {}).create({{&p, 1}, {}}, SamplerContext{});
  for (uint64_t i = 0; i < 16; ++i) {
    const Vec2 u = s->get2D({{4, 5}, i}, 0) * 4.f;
    EXPECT_FLOAT_EQ(u.x - std::floor(u.x), 0.5f);
    EXPECT_FLOAT_EQ(u.y - std::floor(u.y), 0.5f);
  }
}

TEST(Samplers, StratifiedOrdersAreUniform) {
  // Which stratum a sample gets, over pixels.
  for (const int spp : {2, 3, 16, 37}) {
    const auto s = make("stratified", spp);
    const auto n = static_cast<size_t>(spp);
    std::vector<double> counts(n * n), expected(n * n, 3000. / spp);
    for (int p = 0; p < 3000; ++p)
      for (size_t i = 0; i < n; ++i) {
        const float u = s->get1D({{p, 0}, i}, 0);
        ++counts[i * n + static_cast<size_t>(u * static_cast<float>(spp))];
      }
    EXPECT_EQ(test::chiSquareTest(counts, expected), "") << spp;
  }
}

}  // namespace
}  // namespace lampyris
