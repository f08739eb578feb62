// SPDX-License-Identifier: Apache-2.0
#include "accelerators/embree_ball_group.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "support/statistics.h"

namespace lampyris::test {
namespace {

using embree::BallGroup;
using DVec3 = glm::dvec3;

RTCRay makeRay(const Vec3& o, const Vec3& d, float tfar) {
  RTCRay ray{};
  ray.org_x = o.x, ray.org_y = o.y, ray.org_z = o.z;
  ray.dir_x = d.x, ray.dir_y = d.y, ray.dir_z = d.z;
  ray.tfar = tfar;
  return ray;
}

/// Distance of the segment from the point over the ball's radius.
double clearance(const Ball& ball, const Vec3& o, const Vec3& d, float tfar) {
  const DVec3 to = DVec3(ball.center) - DVec3(o), way(d);
  const double t =
      std::clamp(glm::dot(to, way) / glm::dot(way, way), 0., static_cast<double>(tfar));
  return glm::length(t * way - to) / static_cast<double>(ball.radius);
}

TEST(EmbreeBallGroup, MeetsWhatASegmentMeetsAndHardlyMore) {
  int inside = 0, outside = 0;
  for (uint64_t i = 0; i < 20000; ++i) {
    auto number = [i, k = 0u]() mutable { return uniform(4, i, k++); };
    const auto direction = [&] { return Vec3(number() - .5f, number() - .5f, number() - .5f); };
    const float scale = std::exp2(40 * (number() - .5f));
    const size_t count = 1 + i % BallGroup::kSize;
    BallGroup group;
    std::array<Ball, BallGroup::kSize> balls;
    for (size_t k = 0; k < count; ++k) {
      balls[k] = {scale * direction(), scale * .3f * (number() + .01f)};
      group.set(k, balls[k]);
    }
    const float stretch = std::exp2(20 * (number() - .5f));
    const Vec3 o = 4.f * scale * direction(), d = (scale * direction() - o) * stretch;
    const float tfar = i % 3 == 0 ? kInfinity : 2 * number() / stretch;
    const uint32_t met = group.met(makeRay(o, d, tfar));
    EXPECT_EQ(group.all(), (1u << count) - 1);
    EXPECT_EQ(met & ~group.all(), 0u);
    for (size_t k = 0; k < count; ++k) {
      const double c = clearance(balls[k], o, d, tfar);
      if (c <= 1) {
        EXPECT_TRUE(met >> k & 1) << c;
      } else if (c > 1.01) {
        EXPECT_FALSE(met >> k & 1) << c;
      }
      (c <= 1 ? inside : outside) += 1;
    }
  }
  EXPECT_GT(inside, 5000);
  EXPECT_GT(outside, 5000);
}

TEST(EmbreeBallGroup, MeetsTouchingRaysFromFarAway) {
  BallGroup group;
  group.set(0, {Vec3(0), 1});
  for (int k = 0; k <= 20; ++k) {
    const float far = std::exp2(static_cast<float>(k));
    EXPECT_EQ(group.met(makeRay({1, 0, -far}, {0, 0, 1}, kInfinity)), 1u) << far;
    EXPECT_EQ(group.met(makeRay({2, 0, -far}, {0, 0, 1}, kInfinity)), k < 19 ? 0u : 1u) << far;
  }
}

TEST(EmbreeBallGroup, DoesNotJudgeRaysThatAreTooShortToTell) {
  BallGroup group;
  group.set(0, {Vec3(0), 1});
  EXPECT_EQ(group.met(makeRay({9, 0, 0}, {0, 0, 1e-15f}, kInfinity)), 1u);
  EXPECT_EQ(group.met(makeRay({9, 0, 0}, {0, 0, 0}, kInfinity)), 1u);
}

}  // namespace
}  // namespace lampyris::test
