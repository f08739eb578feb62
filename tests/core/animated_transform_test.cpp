// SPDX-License-Identifier: Apache-2.0
#include "core/animated_transform.h"

#include <gtest/gtest.h>

#include "support/statistics.h"

namespace lampyris::test {
namespace {

void expectSame(const Transform& a, const Transform& b, float tolerance) {
  for (int c = 0; c < 4; ++c)
    for (int r = 0; r < 4; ++r) EXPECT_NEAR(a.matrix()[c][r], b.matrix()[c][r], tolerance);
}

TEST(AnimatedTransform, StandsStillOutsideOfItsKeys) {
  const Transform a = Transform::translate({1, 2, 3});
  const Transform b = Transform::rotate(70, {1, 1, 0}) * Transform::scale({1, 3, 2});
  const AnimatedTransform motion(a, 2, b, 4);
  for (const float t : {-kInfinity, 0.f, 2.f}) EXPECT_EQ(motion.at(t), a);
  for (const float t : {4.f, 9.f, kInfinity}) EXPECT_EQ(motion.at(t), b);
  const AnimatedTransform jump(a, 1, b, 1);
  EXPECT_EQ(jump.at(1), a);
  EXPECT_EQ(jump.at(1.0001f), b);
  // Without motion no rounding either.
  EXPECT_EQ(AnimatedTransform(b, 0, b, 1).at(0.3f), b);
}

TEST(AnimatedTransform, PartsAreInterpolatedEachInItsWay) {
  const auto made = [](const Vec3& move, float degrees, const Vec3& scale) {
    return Transform::translate(move) * Transform::rotate(degrees, {1, -2, 0.5f}) *
           Transform::scale(scale);
  };
  const AnimatedTransform motion(made({0, 4, -1}, 20, {1, 2, 1}), 0,
                                 made({2, 0, -1}, 120, {3, 2, 5}), 1);
  for (const float t : {0.001f, 0.25f, 0.5f, 0.9f})
    expectSame(motion.at(t), made({2 * t, 4 - 4 * t, -1}, 20 + 100 * t, {1 + 2 * t, 2, 1 + 4 * t}),
               2e-6f);
  // The shorter way around: from −170° to 170° through 180°.
  const AnimatedTransform turn(Transform::rotate(-170, {0, 0, 1}), 0,
                               Transform::rotate(170, {0, 0, 1}), 1);
  expectSame(turn.at(0.5f), Transform::rotate(180, {0, 0, 1}), 1e-6f);
}

TEST(AnimatedTransform, KeepsShearAndMirrors) {
  glm::mat4 shear(1);
  shear[1][0] = 0.7f;
  const Transform a = Transform::rotate(33, {0, 1, 1}) * Transform(shear);
  const Transform mirror = Transform::scale({-1, 2, 1}) * a;
  for (const Transform& t : {a, mirror}) {
    const AnimatedTransform motion(t, 0, Transform::translate({0, 0, 8}) * t, 1);
    expectSame(motion.at(0.25f), Transform::translate({0, 0, 2}) * t, 5e-6f);
  }
}

TEST(AnimatedTransform, AnySizeIsDecomposed) {
  for (const float s : {1e-12f, 1e-4f, 1e4f, 1e12f}) {
    const Transform a = Transform::scale(Vec3(s));
    const Transform b = Transform::rotate(90, {0, 0, 1}) * a;
    const Vec3 p = AnimatedTransform(a, 0, b, 1).at(0.5f).vector({1, 0, 0}) / s;
    EXPECT_LT(length(p - Vec3(std::sqrt(0.5f), std::sqrt(0.5f), 0)), 1e-6f);
  }
}

TEST(AnimatedTransform, BoundsHoldEveryMoment) {
  const Bounds3 box({-1, 0, 2}, {1, 0.5f, 3});
  for (uint64_t i = 0; i < 60; ++i) {
    const auto random = [&](uint32_t d) { return 2 * uniform(1, i, d) - 1; };
    const auto key = [&](uint32_t d) {
      return Transform::translate(5.f * Vec3(random(d), random(d + 1), random(d + 2))) *
             Transform::rotate(180 * random(d + 3), {random(d + 4), random(d + 5), random(d + 6)}) *
             Transform::scale({1 + 0.9f * random(d + 7), 1, 1 + 0.9f * random(d + 8)});
    };
    const AnimatedTransform motion(key(0), 0, key(10), 1);
    const Bounds3 all = motion.bounds(box);
    float slack = kInfinity;
    for (int k = 0; k <= 1000; ++k) {
      const Transform t = motion.at(static_cast<float>(k) / 1000);
      for (int c = 0; c < 8; ++c) {
        const Vec3 p = t.point(box.corner(c));
        EXPECT_TRUE(all.contains(p));
        const Vec3 above = p - all.min;
        slack = std::min({slack, above.x, above.y, above.z});
      }
    }
    EXPECT_LT(slack, 0.02f * all.diagonal());
  }
  EXPECT_TRUE(AnimatedTransform({}, 0, Transform::translate({1, 0, 0}), 1).bounds({}).empty());
}

}  // namespace
}  // namespace lampyris::test
