// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "shapes/shape_helpers.h"
#include "shapes/triangle_mesh.h"

namespace lampyris::test {
namespace {

const std::vector<Vec3> kOctahedron = {{0, 0, 1},  {1, 0, 0},  {0, 1, 0},
                                       {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
const std::vector<int32_t> kOctahedronIndices = {0, 1, 2, 0, 2, 3, 0, 3, 4, 0, 4, 1,
                                                 5, 2, 1, 5, 3, 2, 5, 4, 3, 5, 1, 4};

Parameters octahedron(int levels) {
  return Parameters()
      .integers("levels", {levels})
      .integers("indices", kOctahedronIndices)
      .points("P", kOctahedron);
}
const TriangleMesh& meshOf(const Shape& shape) { return dynamic_cast<const TriangleMesh&>(shape); }

TEST(LoopSubdiv, CountsAndLimitPositions) {
  for (int levels = 0; levels <= 4; ++levels) {
    const auto shape = makeShape("loopsubdiv", octahedron(levels));
    const TriangleMesh& mesh = meshOf(*shape);
    EXPECT_EQ(mesh.elementCount(), 8u << (2 * levels));
    EXPECT_EQ(mesh.vertexCount(), 2u + (4u << (2 * levels)));
    // Limit positions of control vertices do not depend on the level: at valence 4 Warren's
    // weights give (1 − 4/8) p + Σ ring / 8, and the ring of an octahedron's vertex sums to 0.
    float highest = -1;
    for (size_t i = 0; i < mesh.vertexCount(); ++i)
      highest = std::max(highest, mesh.data().positions[i].z);
    EXPECT_NEAR(highest, 0.5f, 1e-5f);
  }
  EXPECT_EQ(makeShape("loopsubdiv", Parameters()
                                        .integers("nlevels", {1})
                                        .text("scheme", "loop")
                                        .integers("indices", kOctahedronIndices)
                                        .points("P", kOctahedron))
                ->elementCount(),
            32u);
}

TEST(LoopSubdiv, LimitIsRoundAndItsNormalsAreThoseOfTheSurface) {
  const auto shape = makeShape("loopsubdiv", octahedron(4));
  const TriangleMesh& mesh = meshOf(*shape);
  for (size_t i = 0; i < mesh.vertexCount(); ++i) {
    const float r = length(mesh.data().positions[i]);
    EXPECT_GT(r, 0.39f);
    EXPECT_LT(r, 0.5001f);
    // As in pbrt-v3 they point against the order of the vertices, here inward.
    EXPECT_LT(dot(normalize(mesh.data().normals[i]), mesh.data().positions[i]) / r, -0.95f);
  }
  for (uint32_t e = 0; e < mesh.elementCount(); ++e) {
    SurfaceInteraction s;
    mesh.surface(e, {1, {0.33f, 0.33f}}, Ray{}, SurfaceDetail::Basic, s);
    EXPECT_GT(dot(s.n, s.shading.n), 0.99f);
  }
}

TEST(LoopSubdiv, FlatMeshesWithBoundaryStayFlat) {
  // A square of 4 × 4 cells; its boundary rounds the corners and keeps the middle of the edges.
  std::vector<Vec3> p;
  std::vector<int32_t> indices;
  for (int y = 0; y <= 4; ++y)
    for (int x = 0; x <= 4; ++x) p.push_back({static_cast<float>(x), static_cast<float>(y), 2});
  for (int y = 0; y < 4; ++y) {
    for (int x = 0; x < 4; ++x) {
      const int i = 5 * y + x;
      indices.insert(indices.end(), {i, i + 1, i + 6, i, i + 6, i + 5});
    }
  }
  const auto shape =
      makeShape("loopsubdiv", Parameters().integers("indices", indices).points("P", p));
  const TriangleMesh& mesh = meshOf(*shape);
  Bounds3 box;
  float nearestCorner = 10;
  for (size_t i = 0; i < mesh.vertexCount(); ++i) {
    const Vec3 q = mesh.data().positions[i];
    EXPECT_NEAR(q.z, 2, 1e-5f);
    EXPECT_LT(distance(normalize(mesh.data().normals[i]), Vec3(0, 0, -1)), 1e-4f);
    box.extend(q);
    nearestCorner = std::min(nearestCorner, distance(q, Vec3(0, 0, 2)));
  }
  EXPECT_NEAR(box.min.x, 0, 1e-5f);
  EXPECT_NEAR(box.max.y, 4, 1e-5f);
  // The limit of a cubic B-spline's corner: (p₋ + 4 p + p₊) / 6 moves it by (1/6, 1/6).
  EXPECT_NEAR(nearestCorner, std::sqrt(2.f) * 0.2f, 0.05f);
}

TEST(LoopSubdiv, OddMeshesAreHandled) {
  Build build;
  // Two tetrahedra that share a vertex; three triangles on an edge; a vertex without triangles.
  const std::vector<Vec3> p = {{0, 0, 0},  {1, 0, 0},  {0, 1, 0},  {0, 0, 1},
                               {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}, {9, 9, 9}};
  const auto bow = build.make("loopsubdiv", Parameters().points("P", p).integers(
                                                "indices", {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3,
                                                            0, 5, 4, 0, 4, 6, 0, 6, 5, 4, 5, 6}));
  EXPECT_EQ(bow->elementCount(), 8u << 6);
  EXPECT_EQ(build.warnings.size(), 1u);
  const auto fin = build.make("loopsubdiv", Parameters().points("P", p).integers(
                                                "indices", {0, 1, 2, 0, 1, 3, 0, 1, 5, 0, 0, 1}));
  EXPECT_EQ(fin->elementCount(), 3u << 6);
  for (const Shape* s : {bow.get(), fin.get()}) {
    for (uint32_t e = 0; e < s->elementCount(); ++e) {
      SurfaceInteraction at;
      s->surface(e, {1, {0.3f, 0.3f}}, Ray{}, SurfaceDetail::Full, at);
      EXPECT_TRUE(isFinite(at.p) && isFinite(at.n) && isFinite(at.shading.n));
    }
  }
  const auto refused = [&](const Parameters& q) {
    EXPECT_THROW(build.make("loopsubdiv", q), SceneError);
  };
  refused({});
  refused(Parameters().points("P", p));
  refused(Parameters().points("P", p).integers("indices", {0, 1, 8}));
  refused(Parameters().points("P", p).integers("indices", {0, 1}));
  refused(Parameters().points("P", p).integers("indices", {0, 1, -2}));
  refused(Parameters().points("P", p).integers("indices", {1, 1, 2}));
  refused(octahedron(15));
  refused(octahedron(-1));
}

}  // namespace
}  // namespace lampyris::test
