// SPDX-License-Identifier: Apache-2.0
// Shapes that become triangle meshes: heightfields and NURBS patches.
#include <gtest/gtest.h>

#include "shapes/shape_helpers.h"
#include "shapes/triangle_mesh.h"

namespace lampyris::test {
namespace {

const TriangleMeshData& meshOf(const Shape& shape) {
  return dynamic_cast<const TriangleMesh&>(shape).data();
}

Parameters field(int nu, int nv, std::vector<float> z) {
  return Parameters().integers("nu", {nu}).integers("nv", {nv}).floats("Pz", std::move(z));
}

TEST(Heightfield, IsAGridOverTheUnitSquare) {
  const auto shape = makeShape("heightfield", field(3, 2, {0, 1, 2, 3, 4, 5}));
  const TriangleMeshData& mesh = meshOf(*shape);
  EXPECT_EQ(mesh.positions[1], Vec3(0.5f, 0, 1));
  EXPECT_EQ(mesh.positions[5], Vec3(1, 1, 5));
  EXPECT_EQ(mesh.uvs[4], Vec2(0.5f, 1));
  const std::vector<uint32_t> expected = {0, 1, 4, 0, 4, 3, 1, 2, 5, 1, 5, 4};
  EXPECT_EQ(mesh.indices, expected);
}

TEST(Heightfield, WrongCountsAreErrors) {
  EXPECT_THROW(makeShape("heightfield", {}), SceneError);
  EXPECT_THROW(makeShape("heightfield", field(1, 2, {0, 1})), SceneError);
  EXPECT_THROW(makeShape("heightfield", field(3, 2, {0, 1, 2, 3, 4})), SceneError);
  EXPECT_THROW(makeShape("heightfield", field(2147483647, 2147483647, {0})), SceneError);
}

/// A quarter of a unit cylinder about z, exactly, as a rational surface; u runs around.
Parameters quarterCylinder() {
  const float w = std::sqrt(0.5f);
  return Parameters()
      .integers("nu", {3})
      .integers("nv", {2})
      .integers("uorder", {3})
      .integers("vorder", {2})
      .floats("uknots", {0, 0, 0, 2, 2, 2})
      .floats("vknots", {0, 0, 1, 1})
      .floats("Pw", {1, 0, 0, 1, w, w, 0, w, 0, 1, 0, 1, 1, 0, 3, 1, w, w, 3 * w, w, 0, 1, 3, 1});
}

TEST(Nurbs, ACylinderIsExact) {
  const auto shape = makeShape("nurbs", quarterCylinder());
  const TriangleMeshData& mesh = meshOf(*shape);
  ASSERT_EQ(mesh.uvs.size(), 900u);
  EXPECT_EQ(mesh.indices.size(), 29u * 29 * 6);
  for (size_t i = 0; i < 900; ++i) {
    const Vec3& p = mesh.positions[i];
    EXPECT_NEAR(p.x * p.x + p.y * p.y, 1, 1e-6f);
    EXPECT_NEAR(p.z, 3 * mesh.uvs[i].y, 1e-6f);
    EXPECT_LT(distance(mesh.normals[i], Vec3(p.x, p.y, 0)), 1e-5f);
  }
  EXPECT_EQ(mesh.uvs[29], Vec2(2, 0));
  EXPECT_LT(distance(mesh.positions[29], Vec3(0, 1, 0)), 1e-6f);
}

TEST(Nurbs, AnyOrderAndKnotsGivePlanesTheirPoints) {
  // Control points at the Greville abscissae of a plane give the plane itself; repeated knots too.
  const std::vector<float> knots = {0, 0, 0, 0, 1, 1, 2.5f, 4, 4, 4, 4};
  Parameters p;
  p.integers("nu", {7}).integers("uorder", {4}).floats("uknots", knots);
  p.integers("nv", {2}).integers("vorder", {2}).floats("vknots", {-1, 0, 1, 7});
  std::vector<Vec3> points;
  for (int v = 0; v < 2; ++v)
    for (size_t i = 0; i < 7; ++i)
      points.emplace_back((knots[i + 1] + knots[i + 2] + knots[i + 3]) / 3, 5 * v, 1);
  p.points("P", points);
  const auto shape = makeShape("nurbs", p.floats("u0", {0.5f}).floats("u1", {3}));
  const TriangleMeshData& mesh = meshOf(*shape);
  for (size_t i = 0; i < 900; ++i) {
    EXPECT_LT(distance(mesh.positions[i], Vec3(mesh.uvs[i].x, 5 * mesh.uvs[i].y, 1)), 2e-6f);
    EXPECT_LT(distance(mesh.normals[i], Vec3(0, 0, 1)), 1e-6f);
  }
  EXPECT_FLOAT_EQ(mesh.uvs[0].x, 0.5f);
  EXPECT_FLOAT_EQ(mesh.uvs[899].x, 3);
}

TEST(Nurbs, BrokenInputIsRefused) {
  EXPECT_THROW(makeShape("nurbs", {}), SceneError);
  const auto with = [](const char* name, std::vector<float> v) {
    return quarterCylinder().floats(name, std::move(v));
  };
  EXPECT_THROW(makeShape("nurbs", with("uknots", {0, 0, 0, 2, 2})), SceneError);
  EXPECT_THROW(makeShape("nurbs", with("uknots", {0, 0, 2, 0, 2, 2})), SceneError);
  EXPECT_THROW(makeShape("nurbs", with("uknots", {0, 0, 0, 0, 0, 0})), SceneError);
  EXPECT_THROW(makeShape("nurbs", with("uknots", {0, 0, 0, NAN, 2, 2})), SceneError);
  EXPECT_THROW(makeShape("nurbs", with("Pw", {1, 2, 3})), SceneError);
  EXPECT_THROW(makeShape("nurbs", with("u0", {-1})), SceneError);
  EXPECT_THROW(makeShape("nurbs", with("u1", {0})), SceneError);
  EXPECT_THROW(makeShape("nurbs", with("Pw", std::vector<float>(24, 0.f))), SceneError);
  EXPECT_THROW(makeShape("nurbs", quarterCylinder().integers("uorder", {4})), SceneError);
  EXPECT_THROW(makeShape("nurbs", quarterCylinder().integers("uorder", {1000000000})), SceneError);
}

}  // namespace
}  // namespace lampyris::test
