// SPDX-License-Identifier: Apache-2.0
#include "base/interaction.h"

#include <gtest/gtest.h>

#include "core/sampling.h"
#include "support/statistics.h"

namespace lampyris {
namespace {

using test::uniform;

TEST(OffsetRayOrigin, LeavesTheErrorBoxOnTheSideOfTheRay) {
  for (uint64_t i = 0; i < 2000; ++i) {
    const float scale = std::exp2(std::floor(uniform(1, i, 0) * 60 - 30));
    const Vec3 p = scale * (2.f * Vec3(uniform(1, i, 1), uniform(1, i, 2), uniform(1, i, 3)) - 1.f);
    const Vec3 error = roundingBound(7) * glm::abs(p);
    const Vec3 n = sampleUniformSphere({uniform(1, i, 4), uniform(1, i, 5)});
    const Vec3 w = sampleUniformSphere({uniform(1, i, 6), uniform(1, i, 7)});
    const Vec3 o = offsetRayOrigin(p, error, n, w);
    // Every corner of the box lies behind the plane through o.
    const double side = dot(w, n) < 0 ? -1 : 1;
    for (int corner = 0; corner < 8; ++corner) {
      double d = 0;
      for (int axis = 0; axis < 3; ++axis) {
        const double e = (corner >> axis & 1 ? 1. : -1.) * static_cast<double>(error[axis]);
        d += (static_cast<double>(o[axis]) - static_cast<double>(p[axis]) - e) *
             static_cast<double>(n[axis]);
      }
      EXPECT_GE(d * side, 0) << i;
    }
    // And not far away: in units of the size of the coordinates.
    EXPECT_LE(distance(o, p), 1e-5f * length(p));
  }
}

TEST(OffsetRayOrigin, KeepsAnExactPointWhereItIs) {
  const Vec3 p(1, 2, 3);
  EXPECT_EQ(offsetRayOrigin(p, Vec3(0), {0, 0, 1}, {0, 0, 1}), p);
}

SurfaceInteraction planePoint() {
  SurfaceInteraction at;
  at.p = {0.5f, 0.25f, 0};
  at.n = {0, 0, 1};
  at.dpdu = {2, 0, 0};  // u = x / 2
  at.dpdv = {0, 4, 0};  // v = y / 4
  return at;
}

TEST(Differentials, FollowTheFootprintOnAPlane) {
  SurfaceInteraction at = planePoint();
  RayDifferential d;
  d.xOrigin = {0.6f, 0.25f, 1};
  d.yOrigin = {0.5f, 0.45f, 1};
  d.xDirection = d.yDirection = {0, 0, -1};
  at.computeDifferentials(d);
  EXPECT_NEAR(at.dpdx.x, 0.1f, 1e-6f);
  EXPECT_NEAR(at.dpdy.y, 0.2f, 1e-6f);
  EXPECT_NEAR(at.duvdx.x, 0.05f, 1e-6f);
  EXPECT_NEAR(at.duvdx.y, 0, 1e-6f);
  EXPECT_NEAR(at.duvdy.y, 0.05f, 1e-6f);
}

TEST(Differentials, AreZeroWhereUndefined) {
  SurfaceInteraction at = planePoint();
  RayDifferential d;
  d.xDirection = d.yDirection = {1, 0, 0};  // parallel to the surface
  d.xOrigin = d.yOrigin = {0, 0, 1};
  at.computeDifferentials(d);
  EXPECT_EQ(at.duvdx, Vec2(0));
  EXPECT_EQ(at.dpdy, Vec3(0));

  at = planePoint();
  at.dpdv = at.dpdu;  // no parametrisation
  d.xDirection = d.yDirection = {0, 0, -1};
  at.computeDifferentials(d);
  EXPECT_EQ(at.duvdx, Vec2(0));
  EXPECT_EQ(at.duvdy, Vec2(0));
}

}  // namespace
}  // namespace lampyris
