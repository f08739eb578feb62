// SPDX-License-Identifier: Apache-2.0
#include "textures/texture_mapping.h"

#include <gtest/gtest.h>

#include <cmath>

#include "core/math.h"
#include "textures/texture_test_support.h"

namespace lampyris {
namespace {

using namespace test;

TextureMapping2D mapping(const std::string& kind, const Transform& t = Transform()) {
  MappingParameters p;
  p.mapping = kind;
  return {p, t};
}

void expectNear(const Vec2& a, const Vec2& b, float tolerance) {
  EXPECT_NEAR(a.x, b.x, tolerance);
  EXPECT_NEAR(a.y, b.y, tolerance);
}

TEST(TextureMapping, UvScalesTheFootprint) {
  MappingParameters p;
  p.uscale = 2;
  p.vscale = -3;
  p.udelta = 0.5f;
  p.vdelta = 1;
  SurfaceInteraction s = atUv(0.25f, 0.5f);
  s.duvdx = {1, 2};
  s.duvdy = {-0.5f, 4};
  const TextureCoordinates c = TextureMapping2D(p, Transform()).map(s);
  EXPECT_EQ(c.st, Vec2(1, -0.5f));
  EXPECT_EQ(c.dstdx, Vec2(2, -6));
  EXPECT_EQ(c.dstdy, Vec2(-1, -12));
  EXPECT_TRUE(c.hasFootprint());
  EXPECT_FALSE(TextureMapping2D(p, Transform()).map(atUv(0, 0)).hasFootprint());
}

TEST(TextureMapping, PlanarIsInWorldSpace) {
  MappingParameters p;
  p.mapping = "planar";
  p.v1 = {0, 2, 0};
  p.v2 = {1, 0, 1};
  p.udelta = 1;
  p.vdelta = -1;
  SurfaceInteraction s = atPoint({1, 2, 3});
  s.dpdx = {0.5f, 0.25f, 0};
  s.dpdy = {0, 0, 1};
  const TextureCoordinates c = TextureMapping2D(p, Transform::scale(Vec3(7))).map(s);
  EXPECT_EQ(c.st, Vec2(5, 3));
  EXPECT_EQ(c.dstdx, Vec2(0.5f, 0.5f));
  EXPECT_EQ(c.dstdy, Vec2(0, 1));
}

TEST(TextureMapping, SphericalPointsAndPoles) {
  const auto m = mapping("spherical", Transform::translate({5, 0, 0}));
  expectNear(m.map(atPoint({5, 0, 9})).st, {0, 0}, 1e-6f);
  expectNear(m.map(atPoint({5, 0, -9})).st, {1, 0}, 1e-6f);
  expectNear(m.map(atPoint({6, 0, 0})).st, {0.5f, 0}, 1e-6f);
  expectNear(m.map(atPoint({5, 1, 0})).st, {0.5f, 0.25f}, 1e-6f);
  expectNear(m.map(atPoint({5, -1, 0})).st, {0.5f, 0.75f}, 1e-6f);
  // The centre has no direction, but coordinates.
  const Vec2 centre = m.map(atPoint({5, 0, 0})).st;
  EXPECT_TRUE(std::isfinite(centre.x) && std::isfinite(centre.y));
}

TEST(TextureMapping, SphericalDifferentials) {
  const auto m = mapping("spherical");
  // On the equator a small step along y turns φ, one along z turns θ.
  for (const float scale : {1e-3f, 1.f, 1e3f}) {
    SurfaceInteraction s = atPoint(Vec3(scale, 0, 0));
    s.dpdx = Vec3(0, 0.01f * scale, 0);
    s.dpdy = Vec3(0, 0, 0.01f * scale);
    const TextureCoordinates c = m.map(s);
    expectNear(c.dstdx, {0, 0.01f / (2 * kPi)}, 2e-5f);
    expectNear(c.dstdy, {-0.01f / kPi, 0}, 2e-5f);
  }
}

TEST(TextureMapping, SeamsHaveSmallFootprints) {
  // A step over the seam: φ = 0 of the sphere, φ = π of the cylinder.
  SurfaceInteraction s = atPoint({1, 1e-4f, 0});
  s.dpdx = {0, -0.01f, 0};
  expectNear(mapping("spherical").map(s).dstdx, {0, -0.01f / (2 * kPi)}, 2e-5f);
  s = atPoint({-1, 1e-5f, 0});
  s.dpdx = {0, -0.01f, 0};
  expectNear(mapping("cylindrical").map(s).dstdx, {0.01f / (2 * kPi), 0}, 5e-5f);
}

TEST(TextureMapping, CylindricalPoints) {
  const auto m = mapping("cylindrical", Transform::scale(Vec3(2)));
  expectNear(m.map(atPoint({3, 0, 0})).st, {0.5f, 0}, 1e-6f);
  expectNear(m.map(atPoint({0, 3, 0})).st, {0.75f, 0}, 1e-6f);
  expectNear(m.map(atPoint({0, -3, 3})).st, {0.25f, std::sqrt(0.5f)}, 1e-6f);
  expectNear(m.map(atPoint({0, 0, -3})).st, {0.5f, -1}, 1e-6f);
}

TEST(TextureMapping, SingularTransformsAreHarmless) {
  for (const char* kind : {"spherical", "cylindrical"}) {
    SurfaceInteraction s = atPoint({1, 2, 3});
    s.dpdx = {1, 0, 0};
    const TextureCoordinates c = mapping(kind, Transform::scale({1, 0, 1})).map(s);
    EXPECT_TRUE(std::isfinite(c.st.x) && std::isfinite(c.st.y) && std::isfinite(c.dstdx.x));
  }
}

}  // namespace
}  // namespace lampyris
