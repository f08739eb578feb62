// SPDX-License-Identifier: Apache-2.0
#include "core/transform.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/math.h"
#include "support/statistics.h"

namespace lampyris {
namespace {

void expectNear(const Vec3& a, const Vec3& b, float tolerance = 1e-5f) {
  EXPECT_NEAR(length(a - b), 0, tolerance) << a.x << " " << a.y << " " << a.z;
}

float signedUniform(uint64_t i, uint32_t d) { return 2 * test::uniform(3, i, d) - 1; }

Transform randomAffine(uint64_t i, float scale) {
  glm::mat4 m(1);
  uint32_t d = 100;
  for (int c = 0; c < 4; ++c)
    for (int r = 0; r < 3; ++r) m[c][r] = scale * signedUniform(i, d++);
  return Transform(m);
}

TEST(Transform, KnownMaps) {
  expectNear(Transform::translate({1, 2, 3}).point({1, 1, 1}), {2, 3, 4});
  expectNear(Transform::translate({1, 2, 3}).vector({1, 1, 1}), {1, 1, 1});
  expectNear(Transform::scale({2, 3, 4}).point({1, 1, 1}), {2, 3, 4});
  expectNear(Transform::rotate(90, {0, 0, 5}).point({1, 0, 0}), {0, 1, 0});
  expectNear(Transform::rotate(90, {1, 0, 0}).point({0, 1, 0}), {0, 0, 1});
  expectNear(Transform::rotate(120, {1, 1, 1}).point({1, 0, 0}), {0, 1, 0});
  EXPECT_TRUE(Transform::rotate(30, {0, 0, 0}).isIdentity());
  EXPECT_TRUE(Transform().isIdentity());
}

TEST(Transform, ProductAppliesTheRightFactorFirst) {
  const Transform a = Transform::rotate(50, {1, 2, 3}), b = Transform::translate({4, 5, 6});
  const Vec3 p(0.3f, -2, 1);
  expectNear((a * b).point(p), a.point(b.point(p)));
  expectNear((a * b).inverse().point((a * b).point(p)), p);
}

TEST(Transform, InverseOfAnyScale) {
  for (const float s : {1e-12f, 1e-4f, 1.f, 1e4f, 1e12f}) {
    for (uint64_t i = 0; i < 50; ++i) {
      const Transform t = randomAffine(i, s);
      ASSERT_FALSE(t.isSingular());
      const glm::dmat4 product = glm::dmat4(t.matrix()) * glm::dmat4(t.inverseMatrix());
      const double condition =
          std::abs(glm::determinant(glm::dmat3(t.matrix()))) / (static_cast<double>(s) * s * s);
      if (condition < 0.05) continue;
      for (int c = 0; c < 3; ++c)
        for (int r = 0; r < 3; ++r) EXPECT_NEAR(product[c][r], c == r, 1e-5) << s << " " << i;
    }
  }
}

TEST(Transform, SingularMatricesAreFound) {
  EXPECT_TRUE(Transform::scale({1, 0, 1}).isSingular());
  EXPECT_TRUE(Transform(glm::mat4(0)).isSingular());
  glm::mat4 nan(1);
  nan[1][1] = std::nanf("");
  EXPECT_TRUE(Transform(nan).isSingular());
  EXPECT_TRUE(Transform::scale({1, 0, 1}).inverse().isSingular());
  EXPECT_FALSE(Transform::scale(Vec3(1e-15f)).isSingular());
  // Its inverse overflows floats.
  EXPECT_TRUE(Transform::scale(Vec3(1e-42f)).isSingular());
}

TEST(Transform, LookAtIsLeftHandedAsInPbrt) {
  const Transform t = Transform::lookAt({1, 2, 3}, {1, 2, 10}, {0, 5, 0});
  expectNear(t.point({1, 2, 3}), {0, 0, 0});
  expectNear(t.point({1, 2, 10}), {0, 0, 7});
  expectNear(t.vector({0, 1, 0}), {0, 1, 0});
  expectNear(t.vector({1, 0, 0}), {1, 0, 0});
  EXPECT_FALSE(t.swapsHandedness());
  // Seen against z, x points the other way.
  expectNear(Transform::lookAt({0, 0, 5}, {0, 0, 0}, {0, 1, 0}).vector({1, 0, 0}), {-1, 0, 0});
  // An up vector that is not perpendicular.
  const Transform tilted = Transform::lookAt({0, 0, 0}, {1, 1, 0}, {0, 1, 0});
  expectNear(tilted.point({3, 3, 0}), {0, 0, std::sqrt(18.f)});
  EXPECT_GT(tilted.vector({0, 1, 0}).y, 0);
}

TEST(Transform, LookAtWithoutDirectionIsSingular) {
  EXPECT_TRUE(Transform::lookAt({1, 2, 3}, {1, 2, 3}, {0, 1, 0}).isSingular());
  EXPECT_TRUE(Transform::lookAt({0, 0, 0}, {0, 3, 0}, {0, 1, 0}).isSingular());
  EXPECT_TRUE(Transform::lookAt({0, 0, 0}, {0, 0, 1}, {0, 0, 0}).isSingular());
}

TEST(Transform, Handedness) {
  EXPECT_FALSE(Transform().swapsHandedness());
  EXPECT_TRUE(Transform::scale({-1, 1, 1}).swapsHandedness());
  EXPECT_FALSE(Transform::scale({-1, -1, 1}).swapsHandedness());
  EXPECT_TRUE(Transform::scale({-1e-12f, 1e-12f, 1e-12f}).swapsHandedness());
  EXPECT_FALSE(Transform::rotate(77, {3, 1, 2}).swapsHandedness());
}

TEST(Transform, NormalsStayPerpendicular) {
  for (uint64_t i = 0; i < 50; ++i) {
    const Transform t = randomAffine(i, 2);
    const Vec3 a(1, 0.5f, 0), b(0, 1, -2);
    const Vec3 n = normalize(t.normal(cross(a, b)));
    EXPECT_NEAR(dot(n, normalize(t.vector(a))), 0, 2e-5) << i;
    EXPECT_NEAR(dot(n, normalize(t.vector(b))), 0, 2e-5) << i;
  }
}

TEST(Transform, ProjectiveMapsDivideByW) {
  glm::mat4 m(1);
  m[2][3] = 1;
  m[3][3] = 0;
  const Transform p(m);
  expectNear(p.point({3, -6, 3}), {1, -2, 1});
}

TEST(Transform, BoundsContainTheImage) {
  const Transform t = Transform::rotate(33, {1, 2, -1}) * Transform::scale({1, 4, 2});
  const Bounds3 b({-1, -2, -3}, {4, 5, 6}), mapped = t.bounds(b);
  for (uint64_t i = 0; i < 1000; ++i) {
    Vec3 p;
    for (int a = 0; a < 3; ++a)
      p[a] = lerp(test::uniform(5, i, static_cast<uint32_t>(a)), b.min[a], b.max[a]);
    const Vec3 q = t.point(p), e(1e-5f);
    EXPECT_TRUE(Bounds3(mapped.min - e, mapped.max + e).contains(q));
  }
  EXPECT_TRUE(t.bounds(Bounds3()).empty());
}

TEST(Transform, PointErrorBoundsHold) {
  for (uint64_t i = 0; i < 20000; ++i) {
    const float scale = std::pow(10.f, 8 * signedUniform(i, 50));
    const Transform t = randomAffine(i, scale);
    Vec3 p, error;
    glm::dvec4 exact(0, 0, 0, 1);
    for (int a = 0; a < 3; ++a) {
      const auto d = static_cast<uint32_t>(a);
      p[a] = scale * signedUniform(i, d);
      error[a] = std::abs(p[a]) * 1e-5f * test::uniform(3, i, 20 + d);
      exact[a] = static_cast<double>(p[a]) +
                 static_cast<double>(error[a]) * static_cast<double>(signedUniform(i, 30 + d));
    }
    const glm::dvec4 there = glm::dmat4(t.matrix()) * exact;
    const Vec3 got = t.affinePoint(p), bound = t.pointError(p, error),
               rounding = t.pointError(p, Vec3(0));
    const glm::dvec4 unmoved = glm::dmat4(t.matrix()) * glm::dvec4(glm::dvec3(p), 1.);
    for (int a = 0; a < 3; ++a) {
      ASSERT_LE(std::abs(static_cast<double>(got[a]) - there[a]), static_cast<double>(bound[a]));
      ASSERT_LE(std::abs(static_cast<double>(got[a]) - unmoved[a]),
                static_cast<double>(rounding[a]));
      // Not a bound that says nothing.
      ASSERT_LE(rounding[a], 1e-5f * (lengthSquared(p) + 1 + scale * scale + scale));
    }
  }
}

}  // namespace
}  // namespace lampyris
