// SPDX-License-Identifier: Apache-2.0
#include "guiding/clipped_lobe.h"

#include <gtest/gtest.h>

#include "core/frame.h"
#include "support/statistics.h"

namespace lampyris::test {

namespace {

constexpr double kPiD = 3.14159265358979323846;

/// V by quadrature, in polar coordinates about the axis: the share of each circle of latitude that
/// is above the plane is known, and x = cosⁿ⁺¹ takes the power out.
double quadrature(uint32_t n, double tilt) {
  const int steps = 40'000;
  double sum = 0;
  for (int i = 0; i < steps; ++i) {
    const double c = std::pow((i + 0.5) / steps, 1. / (n + 1));
    const double s = std::sqrt(std::max(0., 1 - c * c));
    // Above: s sin(tilt) cos φ > −c cos(tilt).
    const double edge = s * std::sin(tilt) == 0 ? (std::cos(tilt) > 0 ? -2 : 2)
                                                : -c * std::cos(tilt) / (s * std::sin(tilt));
    sum += std::acos(std::clamp(edge, -1., 1.)) * 2;
  }
  return sum / steps / (n + 1);
}

TEST(ClippedLobe, IntegralEqualsQuadrature) {
  for (const uint32_t n : {1u, 2u, 3u, 4u, 5u, 7u, 12u, 33u, 128u, 1001u, 4096u, 16384u})
    for (const double degrees : {0., 5., 30., 60., 80., 88., 89.9, 90., 91., 120., 175.}) {
      const double tilt = degrees * kPiD / 180;
      const double expected = quadrature(n, tilt), got = clippedLobeIntegral(n, std::cos(tilt));
      EXPECT_NEAR(got, expected, 2e-4 * 2 * kPiD / (n + 1)) << n << " at " << degrees;
    }
}

TEST(ClippedLobe, IntegralHasItsKnownValues) {
  for (const uint32_t n : {1u, 2u, 9u, 500u, 100'000u}) {
    const double whole = 2 * kPiD / (n + 1);
    EXPECT_NEAR(clippedLobeIntegral(n, 1), whole, 1e-14 * whole) << n;
    EXPECT_NEAR(clippedLobeIntegral(n, 0), whole / 2, 1e-14 * whole) << n;
    EXPECT_NEAR(clippedLobeIntegral(n, -1), 0, 1e-14 * whole) << n;
    EXPECT_NEAR(clippedLobeIntegral(n, 0.3) + clippedLobeIntegral(n, -0.3), whole, 1e-14 * whole);
  }
  // n = 1: π/2 (1 + cos θ); n = 0 would be the lune itself.
  for (const double c : {0.1, 0.5, 0.9})
    EXPECT_NEAR(clippedLobeIntegral(1, c), kPiD / 2 * (1 + c), 1e-14);
}

TEST(ClippedLobe, FastInverseIsExactToFloat) {
  for (int level = 0; level < kLobeLevels; ++level)
    for (int i = 0; i <= 1000; ++i) {
      const float c = static_cast<float>(i) / 1000;
      const double v = clippedLobeIntegral(lobeExponent(level), static_cast<double>(c));
      ASSERT_NEAR(static_cast<double>(inverseClippedLobe(level, c)) * v, 1, 1.5e-6)
          << lobeExponent(level) << " at " << c;
    }
}

TEST(ClippedLobe, LevelsRoundExponentsUp) {
  EXPECT_EQ(lobeExponent(kLobeLevels - 1), static_cast<uint32_t>(kMaxLobeExponent));
  for (int level = 0; level < kLobeLevels; ++level) {
    const auto n = static_cast<float>(lobeExponent(level));
    EXPECT_EQ(lobeLevel(n), level);
    EXPECT_EQ(lobeLevel(n * 1.001f), std::min(level + 1, kLobeLevels - 1));
  }
  EXPECT_EQ(lobeLevel(-1), 0);
  EXPECT_EQ(lobeLevel(kInfinity), kLobeLevels - 1);
  EXPECT_EQ(lobeLevel(std::nanf("")), 0);
}

TEST(ClippedLobe, PowersAreRight) {
  const Vec3 axis = normalize(Vec3(1, 2, -3));
  const Frame frame = Frame::fromZ(axis);
  for (int level = 0; level < kLobeLevels; ++level) {
    const uint32_t n = lobeExponent(level);
    const float angle = 1 / std::sqrt(static_cast<float>(n) + 1);
    const Vec3 w = frame.toWorld(sphericalDirection(std::sin(angle), std::cos(angle), 2));
    const double expected = std::pow(std::cos(static_cast<double>(angle)), n);
    EXPECT_NEAR(static_cast<double>(lobePower(level, axis, w)), expected, 1e-3 * expected) << n;
    EXPECT_EQ(lobePower(level, axis, -axis), 0);
  }
}

TEST(ClippedLobe, SamplingMatchesTheDensity) {
  const Vec3 n = normalize(Vec3(0.2f, -0.4f, 1));
  const Frame frame = Frame::fromZ(n);
  for (const int level : {0, 3, 8})
    for (const float degrees : {0.f, 50.f, 85.f}) {
      const float tilt = radians(degrees);
      const Vec3 axis = frame.toWorld(sphericalDirection(std::sin(tilt), std::cos(tilt), 0.7f));
      const float inverse = inverseClippedLobe(level, dot(axis, n));
      uint64_t draws = 0;
      DirectionTest test;
      test.samples = 60'000;
      test.subdivisions = 16;
      test.sample = [&](const Vec2& u, float, Vec3& w) {
        NumberSequence more(++draws);
        w = sampleClippedLobe(level, axis, n, u, more);
        return true;
      };
      test.pdf = [&](const Vec3& w) {
        return dot(w, n) > 0 ? static_cast<double>(lobePower(level, axis, w) * inverse) : 0;
      };
      // The rim cuts cells of the test's grid: their quadrature is coarse, so in the frame of n.
      const auto sample = test.sample;
      const auto pdf = test.pdf;
      test.sample = [&](const Vec2& u, float uc, Vec3& w) {
        const bool drawn = sample(u, uc, w);
        w = frame.toLocal(w);
        return drawn;
      };
      test.pdf = [&](const Vec3& w) { return pdf(frame.toWorld(w)); };
      EXPECT_EQ(directionChiSquareTest(test), "") << lobeExponent(level) << " at " << degrees;
    }
}

TEST(ClippedLobe, NarrowLobesStayFinite) {
  const Vec3 n(0, 0, 1), axis = normalize(Vec3(1, 0, 1e-6f));
  for (uint64_t i = 0; i < 2000; ++i) {
    NumberSequence more(i);
    const Vec3 w =
        sampleClippedLobe(kLobeLevels - 1, axis, n, {uniform(1, i, 0), uniform(1, i, 1)}, more);
    ASSERT_TRUE(isFinite(w));
    ASSERT_GT(w.z, 0);
    ASSERT_GT(lobePower(kLobeLevels - 1, axis, w), 0);
  }
}

}  // namespace

}  // namespace lampyris::test
