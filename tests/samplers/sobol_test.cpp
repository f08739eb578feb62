// SPDX-License-Identifier: Apache-2.0
// Stratification of the Sobol'-based samplers, and the arrangement over pixels of "bluenoise".
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <functional>
#include <set>

#include "samplers/owen.h"
#include "samplers/registry.h"
#include "support/statistics.h"

namespace lampyris {
namespace {

std::unique_ptr<Sampler> make(const std::string& name, int spp, uint64_t seed = 0) {
  SamplerContext context;
  context.samplesPerPixel = spp;
  context.seed = seed;
  return samplerRegistry().get(name, {}).create({}, context);
}

/// True if all elementary intervals of volume 1/n hold one of the n = 2^k points.
bool isNet(const std::vector<Vec2>& points) {
  const size_t n = points.size();
  for (size_t columns = 1; columns <= n; columns *= 2) {
    std::vector<int> cells(n);
    const size_t rows = n / columns;
    for (const Vec2& p : points)
      ++cells[static_cast<size_t>(p.x * static_cast<float>(columns)) * rows +
              static_cast<size_t>(p.y * static_cast<float>(rows))];
    for (const int c : cells)
      if (c != 1) return false;
  }
  return true;
}

TEST(Owen, ReversesBits) {
  EXPECT_EQ(reverseBits(uint32_t{1}), 0x80000000u);
  EXPECT_EQ(reverseBits(uint32_t{0x12345678}), 0x1e6a2c48u);
  EXPECT_EQ(reverseBits(uint64_t{0x12345678}), 0x1e6a2c4800000000u);
  for (uint64_t i = 0; i < 100; ++i) EXPECT_EQ(reverseBits(reverseBits(mixBits(i))), mixBits(i));
}

TEST(Owen, SecondSobolCoordinateMatchesItsRecurrence) {
  // Direction numbers of the primitive polynomial x + 1: v' = v ^ v/2 (Sobol' 1967).
  std::array<uint32_t, 32> v{};
  v[0] = 0x80000000u;
  for (size_t i = 1; i < v.size(); ++i) v[i] = v[i - 1] ^ v[i - 1] >> 1;
  for (uint64_t n = 0; n < 2000; ++n) {
    const auto index = static_cast<uint32_t>(n < 1000 ? n : mixBits(n));
    uint32_t y = 0;
    for (size_t i = 0; i < 32; ++i)
      if (index >> i & 1) y ^= v[i];
    EXPECT_EQ(reverseBits(sobolSecond(index)), y);
  }
}

TEST(Owen, ScramblesAreNestedPermutations) {
  for (uint64_t n = 0; n < 200; ++n) {
    const auto seed = static_cast<uint32_t>(mixBits(n));
    std::set<uint32_t> low, low4;
    for (uint32_t i = 0; i < 256; ++i) {
      // The low bits of the result know nothing of the high bits.
      const uint32_t high = static_cast<uint32_t>(mixBits(i)) << 8;
      EXPECT_EQ(scrambleReversed(i, seed) & 0xff, scrambleReversed(i | high, seed) & 0xff);
      EXPECT_EQ(scrambleReversedBase4(i, seed, 0x5555) & 0xff,
                scrambleReversedBase4(i | high, seed, 0x5555) & 0xff);
      low.insert(scrambleReversed(i, seed) & 0xff);
      low4.insert(scrambleReversedBase4(i, seed, 0x5555) & 0xff);
    }
    EXPECT_EQ(low.size(), 256u);
    EXPECT_EQ(low4.size(), 256u);
  }
}

TEST(Owen, EveryDigitSeesAllPermutations) {
  // The second base-4 digit, below each value of the first.
  std::set<std::array<uint32_t, 4>> seen;
  for (uint64_t n = 0; n < 4000; ++n) {
    std::array<uint32_t, 4> permutation{};
    for (uint32_t d = 0; d < 4; ++d)
      permutation[d] =
          scrambleReversedBase4(d << 2 | 1, static_cast<uint32_t>(mixBits(n)), 0x5555) >> 2 & 3;
    seen.insert(permutation);
  }
  EXPECT_EQ(seen.size(), 24u);
}

class SobolBased : public testing::TestWithParam<std::string> {};

INSTANTIATE_TEST_SUITE_P(Samplers, SobolBased,
                         testing::Values("sobol", "halton", "02sequence", "maxmindist",
                                         "bluenoise"),
                         [](const auto& param) { return param.param; });

TEST_P(SobolBased, PrefixesAreNets) {
  for (const int spp : {1, 16, 64, 1024}) {
    const auto s = make(GetParam(), spp);
    for (const Int2& pixel : {Int2(0, 0), Int2(255, 256), Int2(1000, 3)})
      for (const uint32_t d : {0u, 2u, 17u}) {
        std::vector<Vec2> points;
        std::vector<int> strata(static_cast<size_t>(spp));
        for (uint64_t i = 0; i < static_cast<uint64_t>(spp); ++i) {
          points.push_back(s->get2D({pixel, i}, d));
          ++strata[static_cast<size_t>(s->get1D({pixel, i}, d) * static_cast<float>(spp))];
          if (std::has_single_bit(i + 1)) {
            EXPECT_TRUE(isNet(points)) << i << " " << d;
          }
        }
        EXPECT_EQ(strata, std::vector<int>(static_cast<size_t>(spp), 1));
      }
  }
}

TEST_P(SobolBased, RunsBeyondThePlanAreNets) {
  const auto s = make(GetParam(), 16);
  for (const uint64_t first : {uint64_t{16}, uint64_t{32}, uint64_t{64}, uint64_t{1} << 20}) {
    std::vector<Vec2> points;
    for (uint64_t i = 0; i < std::min(first, uint64_t{256}); ++i)
      points.push_back(s->get2D({{77, 5}, first + i}, 4));
    EXPECT_TRUE(isNet(points)) << first;
  }
}

TEST(BlueNoise, BlocksOfPixelsAreStratifiedTogether) {
  const auto s = make("bluenoise", 4);
  for (const uint32_t d : {0u, 6u})
    for (const int size : {2, 4, 16})
      for (const Int2& corner : {Int2(0, 0), Int2(64, 16), Int2(512, 240)}) {
        std::vector<Vec2> points;
        for (int y = 0; y < size; ++y)
          for (int x = 0; x < size; ++x)
            for (uint64_t i = 0; i < 4; ++i)
              points.push_back(s->get2D({corner + Int2(x, y), i}, d));
        EXPECT_TRUE(isNet(points)) << size << " " << d;
      }
}

/// Errors of estimates of ∫f in a square of pixels.
std::vector<double> errorImage(const Sampler& s, int size, uint64_t first, uint64_t spp,
                               const std::function<double(Vec2)>& f, double exact) {
  std::vector<double> errors;
  for (int y = 0; y < size; ++y)
    for (int x = 0; x < size; ++x) {
      double mean = 0;
      for (uint64_t i = 0; i < spp; ++i) mean += f(s.get2D({{x, y}, first + i}, 2));
      errors.push_back(mean / static_cast<double>(spp) - exact);
    }
  return errors;
}

/// Variance of the means of blocks × blocks pixels, relative to what white noise would leave of the
/// variance of the pixels: 1 for white noise.
double lowFrequencies(const std::vector<double>& errors, int size, int block) {
  double pixels = 0, blocks = 0;
  for (const double e : errors) pixels += e * e;
  for (int by = 0; by < size; by += block)
    for (int bx = 0; bx < size; bx += block) {
      double mean = 0;
      for (int y = 0; y < block; ++y)
        for (int x = 0; x < block; ++x)
          mean += errors[static_cast<size_t>((by + y) * size + bx + x)] / (block * block);
      blocks += mean * mean;
    }
  const double n = size * size;
  return (blocks / (n / (block * block))) / (pixels / n / (block * block));
}

TEST(BlueNoise, ErrorHasLittleLowFrequencyEnergy) {
  constexpr int kSize = 128;
  const auto edge = [](Vec2 u) { return u.x + 0.4f * u.y < 0.7f ? 1. : 0.; };
  const auto smooth = [](Vec2 u) { return static_cast<double>(u.x * u.y); };
  for (const int spp : {1, 4, 16, 32}) {
    const auto n = static_cast<uint64_t>(spp);
    const auto blue = make("bluenoise", spp), random = make("random", spp);
    const auto share = [&](const Sampler& s, uint64_t first, int block) {
      return std::max(lowFrequencies(errorImage(s, kSize, first, n, edge, 0.5), kSize, block),
                      lowFrequencies(errorImage(s, kSize, first, n, smooth, 0.25), kSize, block));
    };
    // White noise stays near 1, which shows that the measure tells them apart.
    EXPECT_GT(share(*random, 0, 4), 0.7) << spp;
    EXPECT_LT(share(*blue, 0, 2), 0.75) << spp;
    EXPECT_LT(share(*blue, 0, 4), 0.5) << spp;
    EXPECT_LT(share(*blue, 0, 8), 0.35) << spp;
  }
  // A count that is no power of two is part of a larger plan: no gain to speak of, but no loss.
  const auto odd = make("bluenoise", 13);
  EXPECT_LT(lowFrequencies(errorImage(*odd, kSize, 0, 13, smooth, 0.25), kSize, 4), 1.3);
  // After a run beyond the plan has ended, it holds for that run too.
  const auto blue = make("bluenoise", 4);
  EXPECT_LT(lowFrequencies(errorImage(*blue, kSize, 4, 4, smooth, 0.25), kSize, 4), 0.4);
  EXPECT_LT(lowFrequencies(errorImage(*blue, kSize, 8, 8, smooth, 0.25), kSize, 4), 0.4);
  EXPECT_LT(lowFrequencies(errorImage(*blue, kSize, 0, 16, smooth, 0.25), kSize, 4), 0.5);
}

TEST(BlueNoise, BlocksThatStraddleTheGridProfitToo) {
  constexpr int kSize = 132;
  const auto smooth = [](Vec2 u) { return static_cast<double>(u.x * u.y); };
  const auto blue = make("bluenoise", 4);
  const auto errors = errorImage(*blue, kSize, 0, 4, smooth, 0.25);
  std::vector<double> shifted;
  for (int y = 2; y < kSize - 2; ++y)
    for (int x = 2; x < kSize - 2; ++x)
      shifted.push_back(errors[static_cast<size_t>(y * kSize + x)]);
  EXPECT_LT(lowFrequencies(shifted, kSize - 4, 4), 0.8);
}

TEST(BlueNoise, PixelsHaveNoFixedPattern) {
  // Mean over seeds of one pixel's sample: no pixel may prefer a stratum.
  for (const Int2& pixel : {Int2(0, 0), Int2(1, 0), Int2(127, 128), Int2(255, 255)}) {
    std::vector<double> counts(64), expected(64, 20'000 / 64.);
    for (uint64_t seed = 0; seed < 20'000; ++seed) {
      const Vec2 u = make("bluenoise", 4, seed)->get2D({pixel, seed % 4}, 0);
      ++counts[static_cast<size_t>(u.x * 8) * 8 + static_cast<size_t>(u.y * 8)];
    }
    EXPECT_EQ(test::chiSquareTest(counts, expected), "") << pixel.x;
  }
}

}  // namespace
}  // namespace lampyris
