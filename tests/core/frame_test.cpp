// SPDX-License-Identifier: Apache-2.0
#include "core/frame.h"

#include <gtest/gtest.h>

#include "core/sampling.h"
#include "support/statistics.h"

namespace lampyris {
namespace {

void expectOrthonormal(const Frame& f) {
  EXPECT_NEAR(dot(f.x, f.y), 0, 1e-6);
  EXPECT_NEAR(dot(f.y, f.z), 0, 1e-6);
  EXPECT_NEAR(dot(f.z, f.x), 0, 1e-6);
  EXPECT_NEAR(length(f.x), 1, 1e-6);
  EXPECT_NEAR(length(f.y), 1, 1e-6);
  EXPECT_NEAR(length(cross(f.x, f.y) - f.z), 0, 1e-6);
}

TEST(Frame, IsRightHandedForAnyNormal) {
  for (uint64_t i = 0; i < 2000; ++i)
    expectOrthonormal(
        Frame::fromZ(sampleUniformSphere({test::uniform(1, i, 0), test::uniform(1, i, 1)})));
  for (const Vec3& z : {Vec3(0, 0, 1), Vec3(0, 0, -1), Vec3(1, 0, 0), Vec3(0, -1, 0),
                        Vec3(1, 0, -0.f), Vec3(-1, 0, 0.f)})
    expectOrthonormal(Frame::fromZ(z));
  // Where 1 + z cancels.
  expectOrthonormal(Frame::fromZ(normalize(Vec3(1e-4f, 2e-4f, -1))));
  expectOrthonormal(Frame::fromZ(normalize(Vec3(1e-10f, 0, -1))));
}

TEST(Frame, RoundTrip) {
  const Frame f = Frame::fromZ(normalize(Vec3(1, -2, 0.5f)));
  const Vec3 v(0.3f, 4, -5);
  EXPECT_NEAR(length(f.toWorld(f.toLocal(v)) - v), 0, 2e-6);
  EXPECT_NEAR(length(f.toLocal(f.z) - Vec3(0, 0, 1)), 0, 1e-6);
}

TEST(Frame, Trigonometry) {
  const Vec3 w(0.6f, 0, 0.8f);
  EXPECT_FLOAT_EQ(cosTheta(w), 0.8f);
  EXPECT_FLOAT_EQ(absCosTheta(-w), 0.8f);
  EXPECT_FLOAT_EQ(cos2Theta(w), 0.64f);
  EXPECT_FLOAT_EQ(sin2Theta(w), 0.36f);
  EXPECT_FLOAT_EQ(sinTheta(w), 0.6f);
  EXPECT_FLOAT_EQ(tan2Theta(w), 0.36f / 0.64f);
  EXPECT_EQ(sinTheta({0, 0, 1.0000001f}), 0.f);
  EXPECT_TRUE(sameHemisphere({0, 0, -1}, {1, 0, -0.1f}));
  EXPECT_FALSE(sameHemisphere({0, 0, 1}, {1, 0, -0.1f}));
  EXPECT_FALSE(sameHemisphere({0, 0, 1}, {1, 0, 0}));
}

TEST(Frame, SphericalCoordinatesRoundTrip) {
  for (const float theta : {0.1f, 1.f, 1.5707f, 3.f})
    for (const float phi : {0.f, 0.5f, 3.f, 4.f, 6.28f}) {
      const Vec3 w = sphericalDirection(std::sin(theta), std::cos(theta), phi);
      EXPECT_NEAR(sphericalTheta(w), theta, 1e-5);
      EXPECT_NEAR(sphericalPhi(w), phi, 1e-5);
    }
}

TEST(Frame, AzimuthStaysBelowAFullTurn) {
  for (const float y : {-1e-45f, -1e-30f, -1e-8f, -1e-7f, -3e-7f, -1e-3f}) {
    const float phi = sphericalPhi({1, y, 0});
    EXPECT_GE(phi, 0.f) << y;
    EXPECT_LT(phi, 2 * kPi) << y;
  }
  EXPECT_EQ(sphericalPhi({1, -0.f, 0}), 0.f);
  EXPECT_EQ(sphericalPhi({0, 0, 1}), 0.f);
  EXPECT_FLOAT_EQ(sphericalPhi({-1, 0, 0}), kPi);
}

}  // namespace
}  // namespace lampyris
