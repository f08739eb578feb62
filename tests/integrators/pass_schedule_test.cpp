// SPDX-License-Identifier: Apache-2.0
#include "integrators/pass_schedule.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace lampyris {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::infinity();

RenderOptions limits(double seconds, double noise, std::vector<RenderStop> stops = {}) {
  RenderOptions o;
  o.seconds = seconds;
  o.noise = noise;
  o.stops = std::move(stops);
  return o;
}

/// A render whose clock is simulated: a sample of all pixels takes `cost` seconds, and the noise
/// after n samples is 1 / √n.
struct Simulation {
  RenderOptions options = limits(0, 0);
  uint64_t target = 0;
  double cost = 0.01;

  double seconds = 0;
  double samples = 0;
  uint64_t passes = 0;
  uint64_t largestPass = 0;
  std::vector<std::pair<size_t, double>> stops{};  ///< index, mean samples when it was met

  void run() {
    PassSchedule schedule(options, target);
    uint64_t done = 0;
    while (const auto pass = schedule.next(done, seconds, noise())) {
      ASSERT_LT(++passes, 1000u);
      largestPass = std::max(largestPass, pass->samples);
      const double end = static_cast<double>(done + pass->samples);
      double time = (end - samples) * cost;
      if (pass->deadline > 0) {
        ASSERT_EQ(pass->samples, 1u);
        time = std::min(time, std::max(0., pass->deadline - seconds));
      }
      const double rendered = std::min(time / cost, end - samples);
      samples += rendered;
      seconds += time;
      if (samples > end - 1e-9) done += pass->samples, samples = end;
      schedule.passDone(rendered, time);
      for (const size_t i : schedule.takeStops(done, seconds)) stops.emplace_back(i, samples);
    }
  }
  double noise() const { return samples < 2 ? kUnknown : 1 / std::sqrt(samples); }
};

TEST(PassSchedule, PassesDoubleUpToTheTarget) {
  Simulation s;
  s.target = 1000;
  s.cost = 1e-6;
  s.run();
  EXPECT_EQ(s.samples, 1000);
  EXPECT_EQ(s.passes, 11u);
}

TEST(PassSchedule, PassesAreShort) {
  Simulation s;
  s.target = 1000;
  s.cost = 0.1;
  s.run();
  EXPECT_EQ(s.largestPass, 40u);
}

TEST(PassSchedule, DeadlinesAreMet) {
  for (const double cost : {1e-5, 0.003, 0.4, 3.}) {
    Simulation s;
    s.options.seconds = 10;
    s.cost = cost;
    s.run();
    EXPECT_NEAR(s.seconds, 10, 1e-6) << cost;
    EXPECT_NEAR(s.samples, 10 / cost, 1e-3) << cost;
    EXPECT_LT(s.passes, 60u) << cost;
  }
}

TEST(PassSchedule, EveryPixelGetsASample) {
  Simulation s;
  s.options.seconds = 1;
  s.cost = 25;
  s.run();
  EXPECT_EQ(s.samples, 1);
  EXPECT_EQ(s.seconds, 25);
}

TEST(PassSchedule, WhicheverLimitComesFirst) {
  Simulation bySamples{.options = limits(10, 0.01), .target = 50};
  bySamples.run();
  EXPECT_EQ(bySamples.samples, 50);
  Simulation byTime{.options = limits(0.2, 0.01), .target = 50};
  byTime.run();
  EXPECT_NEAR(byTime.samples, 20, 1e-6);
  Simulation byNoise{.options = limits(10, 0.2), .target = 50};
  byNoise.run();
  EXPECT_EQ(byNoise.samples, 25);
}

TEST(PassSchedule, NoiseIsReachedWithoutWaste) {
  Simulation s{.options = limits(0, 0.0123), .cost = 1e-6};
  s.run();
  EXPECT_NEAR(s.samples, 1 / (0.0123 * 0.0123), 2);
  // With few samples the estimate is not believed.
  Simulation easy{.options = limits(0, 0.9)};
  easy.run();
  EXPECT_EQ(easy.samples, 16);
}

TEST(PassSchedule, StopsAreMetExactly) {
  Simulation s{.options = limits(2, 0, {{100, 0}, {0, 0.505}, {1, 0}, {0, 2}, {37, 0}, {0, 1e-3}})};
  s.run();
  ASSERT_EQ(s.stops.size(), 6u);
  const auto at = [&](size_t stop) {
    for (const auto& [i, samples] : s.stops)
      if (i == stop) return samples;
    return -1.;
  };
  EXPECT_EQ(at(0), 100);
  EXPECT_NEAR(at(1), 50.5, 1e-6);
  EXPECT_EQ(at(2), 1);
  EXPECT_NEAR(at(3), 200, 1e-6);
  EXPECT_EQ(at(4), 37);
  EXPECT_EQ(at(5), 1);  // not before there is an image
}

TEST(PassSchedule, StopsBeyondTheEndAreLeftOut) {
  Simulation s{.options = limits(0, 0, {{8, 0}, {9, 0}, {0, 5}}), .target = 8};
  s.run();
  ASSERT_EQ(s.stops.size(), 1u);
  EXPECT_EQ(s.stops[0].first, 0u);
}

TEST(PassSchedule, Fractions) {
  const RenderOptions options = limits(10, 0.1);
  const PassSchedule s(options, 100);
  EXPECT_DOUBLE_EQ(s.fraction(25, 1, kUnknown), 0.25);
  EXPECT_DOUBLE_EQ(s.fraction(25, 5, kUnknown), 0.5);
  EXPECT_DOUBLE_EQ(s.fraction(25, 1, 0.1 * std::sqrt(2.)), 0.5);
  EXPECT_EQ(s.fraction(200, 1, kUnknown), 1);
}

}  // namespace
}  // namespace lampyris
