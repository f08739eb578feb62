// SPDX-License-Identifier: Apache-2.0
// Bump maps against the normals of height fields.
#include <gtest/gtest.h>

#include "material_cases.h"
#include "materials/registry.h"

namespace lampyris::test {
namespace {

using Height = std::function<float(const SurfaceInteraction&)>;

/// `at` as a matte material with this bump map leaves it.
SurfaceInteraction bumped(SurfaceInteraction at, const Height& height, Bsdf* out = nullptr) {
  TestBuild build;
  build.textures.addFloat("height", height);
  const auto& plugin = materialRegistry().get("matte", {});
  const TestParameters p(plugin.schema, {{"bumpmap", "@height"}});
  Bsdf bsdf;
  plugin.create(p.set(), build.materialContext())->evaluate(at, out ? *out : bsdf);
  return at;
}

SurfaceInteraction plane() {
  SurfaceInteraction at;
  at.uv = Vec2(0.25f, 0.5f);
  at.dpdu = at.shading.dpdu = Vec3(2, 0, 0);
  at.dpdv = at.shading.dpdv = Vec3(0, 3, 0);
  return at;
}

TEST(BumpMap, SlopesBendTheNormal) {
  Bsdf bsdf;
  const auto at = bumped(
      plane(), [](const auto& s) { return 0.5f * s.uv.x - 0.7f * s.uv.y; }, &bsdf);
  // (2, 0, 0.5) × (0, 3, −0.7).
  const Vec3 expected = normalize(Vec3(-3 * 0.5f, 2 * 0.7f, 6));
  EXPECT_LT(length(at.shading.n - expected), 1e-3f);
  EXPECT_EQ(at.n, Vec3(0, 0, 1)) << "the surface itself stays";
  EXPECT_EQ(bsdf.frame().z, at.shading.n);
  EXPECT_EQ(bsdf.geometricNormal(), at.n);
}

TEST(BumpMap, MovesThePointForTexturesInSpace) {
  const auto at = bumped(plane(), [](const auto& s) { return 0.25f * s.p.x; });
  EXPECT_LT(length(at.shading.n - normalize(Vec3(-0.25f, 0, 1))), 1e-3f);
}

TEST(BumpMap, TakesHalfAPixelsFootprintAsStep) {
  auto at = plane();
  at.duvdx = Vec2(0.1f, 0), at.duvdy = Vec2(-0.3f, 0);
  // A step of 0.2 sees u² rise by 0.2 (2 u + 0.2), v by the default step.
  const auto bent = bumped(at, [](const auto& s) { return s.uv.x * s.uv.x; });
  const float slope = 2 * 0.25f + 0.2f;
  EXPECT_LT(length(bent.shading.n - normalize(Vec3(-slope / 2, 0, 1))), 1e-4f);
}

TEST(BumpMap, ConstantHeightOnASphereKeepsTheNormal) {
  SurfaceInteraction at;
  const Vec3 n = normalize(Vec3(1, 2, 2));
  const float radius = 3;
  at.n = at.shading.n = n;
  at.dpdu = at.shading.dpdu = radius * normalize(Vec3(-2, 1, 0));
  at.dpdv = at.shading.dpdv = cross(n, at.dpdu);
  at.dndu = at.shading.dndu = at.dpdu / radius;
  at.dndv = at.shading.dndv = at.dpdv / radius;
  const auto bent = bumped(at, [](const auto&) { return 0.5f; });
  EXPECT_LT(length(bent.shading.n - n), 1e-5f);
  EXPECT_NEAR(length(bent.shading.dpdu), radius + 0.5f, 1e-5f);
}

TEST(BumpMap, TheNormalStaysOnTheSurfacesSide) {
  auto at = plane();
  at.n = at.shading.n = Vec3(0, 0, -1);
  const auto bent = bumped(at, [](const auto& s) { return 0.5f * s.uv.x; });
  EXPECT_LT(bent.shading.n.z, 0);
  // Displaced along −z: (2, 0, −0.5) × (0, 3, 0), turned over.
  EXPECT_LT(length(bent.shading.n - normalize(Vec3(-1.5f, 0, -6))), 1e-3f);
}

TEST(BumpMap, IsScaleFree) {
  const auto reference = bumped(plane(), [](const auto& s) { return 0.5f * s.uv.x; });
  for (const float scale : {1e-4f, 1e4f}) {
    auto at = plane();
    at.shading.dpdu *= scale, at.shading.dpdv *= scale;
    const auto bent = bumped(at, [scale](const auto& s) { return scale * 0.5f * s.uv.x; });
    EXPECT_LT(length(bent.shading.n - reference.shading.n), 1e-3f);
  }
}

TEST(BumpMap, DegenerateInputLeavesTheNormal) {
  const float nan = std::nanf("");
  const auto expectUnbent = [](const SurfaceInteraction& at, const Height& height) {
    const auto bent = bumped(at, height);
    EXPECT_EQ(bent.shading.n, at.shading.n);
  };
  expectUnbent(plane(), [nan](const auto&) { return nan; });
  expectUnbent(plane(), [](const auto& s) { return s.uv.x > 0.25f ? kInfinity : 0.f; });
  auto at = plane();
  at.shading.dpdu = at.shading.dpdv = Vec3(0);
  expectUnbent(at, [](const auto&) { return 0.f; });
  at = plane();
  at.duvdx = Vec2(nan, kInfinity);
  const auto bent = bumped(at, [](const auto& s) { return s.uv.x; });
  EXPECT_TRUE(isFinite(bent.shading.n));
}

}  // namespace
}  // namespace lampyris::test
