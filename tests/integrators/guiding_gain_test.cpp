// SPDX-License-Identifier: Apache-2.0
#include "integrators/guiding_gain.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

namespace lampyris {
namespace {

/// Paths of two choices among two ways, with roulette between them; a term after either choice.
struct TwoSteps {
  using Pair = std::array<double, 2>;
  Pair chances;   ///< of the first way, by step
  Pair survival;  ///< by the first choice

  static double light(int first) { return first == 0 ? 1 : 0.2; }
  static double light(int first, int second) { return (second == 0 ? 3 : 0.5) + 0.1 * first; }
  double chance(size_t step, int way) const { return way == 0 ? chances[step] : 1 - chances[step]; }

  double variance() const {
    double mean = 0, square = 0;
    for (const int i : {0, 1}) {
      const double p = chance(0, i), survives = survival[static_cast<size_t>(i)];
      const double early = light(i) / p;
      mean += p * early;
      square += p * (1 - survives) * early * early;
      for (const int j : {0, 1}) {
        const double q = p * survives * chance(1, j);
        mean += light(i, j);
        square += q * std::pow(early + light(i, j) / q, 2);
      }
    }
    return square - mean * mean;
  }

  /// A path that is drawn from here, weighed also as if it were drawn from `other`.
  PairedRadiance draw(const TwoSteps& other, std::mt19937& rng) const {
    const auto choose = [&rng](double chance) {
      return std::uniform_real_distribution<>()(rng) < chance ? 0 : 1;
    };
    const auto grey = [](double value) { return Rgb(static_cast<float>(value)); };
    PairedRadiance out;
    double odds = 1;
    const int i = choose(chances[0]);
    const double p = chance(0, i);
    odds *= p / other.chance(0, i);
    out.add(grey(light(i) / p), odds);
    const auto at = static_cast<size_t>(i);
    if (choose(survival[at]) == 1) return out;
    odds *= survival[at] / other.survival[at];
    const int j = choose(chances[1]);
    odds *= chance(1, j) / other.chance(1, j);
    out.add(grey(light(i, j) / (p * survival[at] * chance(1, j))), odds);
    return out;
  }

  GuidingGain gain(const TwoSteps& other, int pixels, int samples) const {
    std::mt19937 rng(7);
    GuidingGain all;
    for (int x = 0; x < pixels; ++x) {
      GuidingGain part;
      for (int k = 0; k < samples; ++k) part.add({x, 0}, draw(other, rng));
      part.finish();
      all += part;
    }
    return all;
  }
};

constexpr TwoSteps kBlind{{0.5, 0.5}, {0.6, 0.6}}, kGood{{0.6, 0.8}, {1, 0.9}},
    kBad{{0.25, 0.2}, {0.5, 0.5}};

TEST(GuidingGain, TellsBothVariancesFromTheSamplesOfOne) {
  for (const TwoSteps& guided : {kGood, kBad})
    EXPECT_NEAR(guided.gain(kBlind, 60000, 8).varianceRatio() * kBlind.variance(),
                guided.variance(), 0.03 * guided.variance());
  EXPECT_NEAR(kBlind.gain(kBlind, 100, 8).varianceRatio(), 1, 1e-6);
}

TEST(GuidingGain, SaysWhetherAGuidePays) {
  EXPECT_TRUE(kGood.gain(kBlind, 5000, 4).pays());
  EXPECT_FALSE(kBad.gain(kBlind, 5000, 4).pays());
  EXPECT_FALSE(kBlind.gain(kBlind, 5000, 4).pays()) << "as good as none, but takes time";
}

TEST(GuidingGain, ForgetsEarlyPasses) {
  GuidingGain gain = kBad.gain(kBlind, 2000, 4);
  for (int pass = 0; pass < 12; ++pass) {
    gain.fade();
    gain += kGood.gain(kBlind, 2000, 4);
  }
  EXPECT_TRUE(gain.pays());
  EXPECT_NEAR(gain.varianceRatio(), kGood.gain(kBlind, 2000, 4).varianceRatio(), 0.01);
}

TEST(GuidingGain, SaysNothingOfFewSamples) {
  EXPECT_TRUE(GuidingGain().pays());
  EXPECT_TRUE(kBad.gain(kBlind, 5000, 1).pays());
  EXPECT_TRUE(kBad.gain(kBlind, 2, 2).pays());
}

TEST(GuidingGain, SurvivesWhateverItIsGiven) {
  GuidingGain gain = kGood.gain(kBlind, 100, 4);
  const double before = gain.varianceRatio();
  for (const float radiance : {0.f, 1e-38f, 1e38f, HUGE_VALF, -HUGE_VALF, std::nanf("")})
    for (const double odds : {0., 1e-300, 1e300, HUGE_VAL}) {
      GuidingGain one;
      PairedRadiance path;
      path.add(Rgb(radiance), odds);
      one.add({0, 0}, path);
      one.add({0, 0}, {});
      one.finish();
      gain += one;
    }
  EXPECT_TRUE(std::isfinite(gain.varianceRatio())) << before;
}

}  // namespace
}  // namespace lampyris
