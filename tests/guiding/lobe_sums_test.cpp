// SPDX-License-Identifier: Apache-2.0
#include "guiding/lobe_sums.h"

#include <gtest/gtest.h>

#include "core/sampling.h"
#include "guiding/turning_axis.h"
#include "support/statistics.h"

namespace lampyris::test {

namespace {

constexpr int kCount = 200;

Vec3 place(int i) {
  const auto u = [i](uint32_t d) { return uniform(3, static_cast<uint64_t>(i), d); };
  return Vec3(u(0), u(1), u(2)) - 0.5f;
}

double part(int i) { return 0.5 + static_cast<double>(uniform(4, static_cast<uint64_t>(i), 0)); }

/// Directions towards `lamp` (negative `sign`: away from it) from places around the origin.
LobeSums sumsAround(const Vec3& lamp, float sign, const Vec3& anchor, int from = 0,
                    int to = kCount) {
  LobeSums sums;
  for (int i = from; i < to; ++i)
    sums.add(glm::dvec3(place(i)) - glm::dvec3(anchor), sign * normalize(lamp - place(i)), part(i));
  return sums;
}

TEST(LobeSums, FindHowFarTheLampIs) {
  const Vec3 to = normalize(Vec3(1, 2, -1));
  for (const float distance : {5.f, 20.f, 1000.f})
    for (const float sign : {1.f, -1.f}) {
      const LobeSums sums = sumsAround(distance * to, sign, Vec3(0));
      const glm::dvec3 mean = glm::normalize(sums.direction);
      const LobeSums::Turn t = sums.fitTurn(mean);
      EXPECT_NEAR(t.turn * static_cast<double>(sign * distance), 1, 0.05) << distance;
      EXPECT_NEAR(t.gain, sums.spread(), 0.05 * sums.spread()) << "nothing else spreads them";
    }
}

TEST(LobeSums, TheTurnIsTheLeastSpread) {
  const Vec3 lamp(3, -1, 4);
  const LobeSums sums = sumsAround(lamp, 1, Vec3(0));
  const glm::dvec3 mean = glm::normalize(sums.direction);
  const double best = sums.fitTurn(mean).turn;
  const auto spread = [&](double turn) {
    const TurningAxis axis{Vec3(mean), Vec3(sums.place / sums.weight), static_cast<float>(turn)};
    double sum = 0;
    for (int i = 0; i < kCount; ++i)
      sum += part(i) *
             static_cast<double>(lengthSquared(axis.at(place(i)) - normalize(lamp - place(i)))) / 2;
    return sum;
  };
  EXPECT_LT(spread(best), 0.1 * spread(0));
  EXPECT_NEAR(spread(0), sums.spread(), 0.02 * spread(0));
  EXPECT_LT(spread(best), spread(0.9 * best));
  EXPECT_LT(spread(best), spread(1.1 * best));
}

TEST(LobeSums, DirectionsThatDoNotTurnHaveNoTurn) {
  LobeSums sums;
  for (int i = 0; i < kCount; ++i)
    sums.add(glm::dvec3(place(i)), normalize(Vec3(0, 0, 10) + place(kCount + i)), 1);
  EXPECT_NEAR(sums.fitTurn({0, 0, 1}).turn, 0, 0.02);
  LobeSums onePlace;
  for (int i = 0; i < kCount; ++i) onePlace.add({1, 2, 3}, normalize(place(i)), 1);
  EXPECT_EQ(onePlace.fitTurn({0, 0, 1}).turn, 0) << "cannot be told";
}

TEST(LobeSums, PartsWithAnchorsOfTheirOwnAddUp) {
  const Vec3 lamp(3, -1, 4), anchor(10, -20, 5), other(0.25f, 0.5f, 8);
  const LobeSums whole = sumsAround(lamp, 1, anchor);
  LobeSums parts = sumsAround(lamp, 1, anchor, 0, 50);
  parts.add(sumsAround(lamp, 1, other, 50), glm::dvec3(other) - glm::dvec3(anchor));
  const auto near = [](double a, double b) { EXPECT_NEAR(a, b, 1e-4 * (1 + std::abs(b))); };
  near(parts.weight, whole.weight);
  near(parts.count(), whole.count());
  near(parts.both, whole.both);
  for (int i = 0; i < 3; ++i) {
    near(parts.direction[i], whole.direction[i]);
    near(parts.place[i], whole.place[i]);
    for (int k = 0; k < 3; ++k) near(parts.places[i][k], whole.places[i][k]);
  }
  near(parts.fitTurn(glm::dvec3(normalize(lamp))).turn,
       whole.fitTurn(glm::dvec3(normalize(lamp))).turn);
  parts.scale(2);
  near(parts.spread(), 2 * whole.spread());
  near(parts.count(), 2 * whole.count());
}

}  // namespace

}  // namespace lampyris::test
