// SPDX-License-Identifier: Apache-2.0
#include "shapes/triangle_mesh.h"

#include <gtest/gtest.h>

#include "shapes/shape_helpers.h"

namespace lampyris::test {
namespace {

const std::vector<Vec3> kCorners = {{0, 0, 1}, {2, 0, 1}, {0, 3, 1.5f}};

Parameters triangle() { return Parameters().integers("indices", {0, 1, 2}).points("P", kCorners); }

SurfaceInteraction at(const Shape& shape, const Vec2& b,
                      SurfaceDetail detail = SurfaceDetail::Full) {
  SurfaceInteraction s;
  shape.surface(0, {1, b}, Ray{{0, 0, -1}, {0, 0, 1}}, detail, s);
  return s;
}

std::string errorOf(const Parameters& p, const Transform& t = {}) {
  try {
    makeShape("trianglemesh", p, t);
  } catch (const SceneError& e) {
    return e.what();
  }
  return "";
}

TEST(TriangleMesh, PositionsUvAndDerivatives) {
  const auto plain = makeShape("trianglemesh", triangle());
  const SurfaceInteraction s = at(*plain, {0.25f, 0.5f});
  EXPECT_LT(distance(s.p, 0.25f * kCorners[0] + 0.25f * kCorners[1] + 0.5f * kCorners[2]), 1e-6f);
  EXPECT_NEAR(s.uv.x, 0.75f, 1e-6f);
  EXPECT_NEAR(s.uv.y, 0.5f, 1e-6f);
  EXPECT_LT(distance(s.dpdu, kCorners[1] - kCorners[0]), 1e-5f);
  EXPECT_LT(distance(s.dpdv, kCorners[2] - kCorners[1]), 1e-5f);
  for (const char* name : {"uv", "st"}) {
    for (const ParameterType type : {ParameterType::Float, ParameterType::Point2}) {
      const auto textured =
          makeShape("trianglemesh", triangle().floats(name, {1, 1, 3, 1, 1, 5}, type));
      const SurfaceInteraction t = at(*textured, {0.5f, 0.25f});
      EXPECT_NEAR(t.uv.x, 2, 1e-6f);
      EXPECT_NEAR(t.uv.y, 2, 1e-6f);
      EXPECT_LT(distance(t.dpdu, 0.5f * (kCorners[1] - kCorners[0])), 1e-5f);
    }
  }
}

TEST(TriangleMesh, LocatesItsSamples) {
  for (const float scale : {1e-4f, 1.f, 1e4f}) {
    const auto mesh = makeShape(
        "trianglemesh",
        triangle().floats("uv", {0.1f, 0.2f, 0.8f, 0.3f, 0.4f, 0.9f}, ParameterType::Point2),
        Transform::translate(Vec3(3 * scale)) * Transform::scale(Vec3(scale)));
    for (uint64_t i = 0; i < 500; ++i) {
      const auto s = mesh->sampleArea(0, {uniform(3, i, 0), uniform(3, i, 1)});
      const auto hit = mesh->locate(0, s->p, s->n);
      ASSERT_TRUE(hit);
      EXPECT_GE(1 - hit->uv.x - hit->uv.y, -1e-6f);
      EXPECT_LT(distance(at(*mesh, hit->uv).p, s->p), 1e-5f * scale);
    }
  }
}

TEST(TriangleMesh, DegenerateUvHaveAnArbitraryFrame) {
  const auto mesh = makeShape(
      "trianglemesh", triangle()
                          .floats("uv", {0.5f, 0.5f, 0.5f, 0.5f, 0.5f, 0.5f})
                          .points("N", {{0, 0, 1}, {1, 0, 1}, {0, 1, 1}}, ParameterType::Normal));
  const SurfaceInteraction s = at(*mesh, {0.3f, 0.3f});
  EXPECT_NEAR(length(cross(s.dpdu, s.dpdv)), 1, 1e-5f);
  EXPECT_NEAR(dot(s.dpdu, s.n), 0, 1e-5f);
  // dndu is along that frame: a step along dpdu turns the normal so.
  const float h = 1e-2f;
  // Barycentrics of a step along dpdu, by least squares in the plane.
  const Vec3 e1 = kCorners[1] - kCorners[0], e2 = kCorners[2] - kCorners[0];
  const float a = dot(e1, e1), b = dot(e1, e2), c = dot(e2, e2), d = a * c - b * b;
  const Vec2 db((c * dot(e1, s.dpdu) - b * dot(e2, s.dpdu)) / d,
                (a * dot(e2, s.dpdu) - b * dot(e1, s.dpdu)) / d);
  const Vec3 n0 = at(*mesh, Vec2(0.3f) - h * db).shading.n,
             n1 = at(*mesh, Vec2(0.3f) + h * db).shading.n;
  EXPECT_LT(distance((n1 - n0) / (2 * h), s.shading.dndu), 1e-3f);
}

TEST(TriangleMesh, NormalDerivativesAreThoseOfFiniteDifferences) {
  const Parameters p =
      triangle().points("N", {{0, 0, 2}, {1, 0.5f, 1}, {-0.3f, 1, 1}}, ParameterType::Normal);
  for (const bool reverse : {false, true}) {
    const auto mesh = makeShape("trianglemesh", p, Transform::scale({2, 1, -3}), reverse);
    const Vec2 b(0.3f, 0.4f);
    const float h = 1e-2f;
    // With the default uv: u = b1 + b2, v = b2.
    const SurfaceInteraction s = at(*mesh, b);
    const auto n = [&](const Vec2& step) { return at(*mesh, b + step).shading.n; };
    EXPECT_LT(distance((n({h, 0}) - n({-h, 0})) / (2 * h), s.shading.dndu), 1e-3f);
    EXPECT_LT(distance((n({-h, h}) - n({h, -h})) / (2 * h), s.shading.dndv), 2e-3f);
    EXPECT_EQ(at(*mesh, b, SurfaceDetail::Basic).shading.dndu, Vec3(0));
  }
}

TEST(TriangleMesh, Orientation) {
  const std::vector<Vec3> up(3, Vec3(0, 0, 1)), down(3, Vec3(0, 0, -2));
  for (const bool mirror : {false, true}) {
    for (const bool reverse : {false, true}) {
      const Transform map = mirror ? Transform::scale({-1, 1, 1}) : Transform();
      // The vertices go counter-clockwise about +z; a mirror in x leaves that side what it was.
      const auto plain = makeShape("trianglemesh", triangle(), map, reverse);
      EXPECT_GT(at(*plain, {0.2f, 0.2f}).n.z * (reverse ? -1 : 1), 0);
      EXPECT_EQ(at(*plain, {0.2f, 0.2f}).n, at(*plain, {0.2f, 0.2f}).shading.n);
      for (const auto& [normals, side] : {std::pair(up, 1.f), std::pair(down, -1.f)}) {
        const auto mesh = makeShape(
            "trianglemesh", triangle().points("N", normals, ParameterType::Normal), map, reverse);
        const float want = reverse ? -side : side;
        const SurfaceInteraction s = at(*mesh, {0.2f, 0.2f});
        EXPECT_GT(s.n.z * want, 0.9f);
        EXPECT_NEAR(s.shading.n.z, want, 1e-6f);
        EXPECT_LT(distance(cross(s.shading.dpdu, s.shading.dpdv), s.shading.n), 1e-5f);
        EXPECT_GT(dot(mesh->sampleArea(0, {0.3f, 0.3f})->n, s.n), 0.9999f);
        EXPECT_GT(dot(mesh->normalCone(0).axis, s.n), 0.9999f);
        EXPECT_EQ(mesh->normalCone(0).cosTheta, 1);
      }
      EXPECT_GT(dot(plain->sampleArea(0, {0.3f, 0.3f})->n, at(*plain, {0.2f, 0.2f}).n), 0.9999f);
      EXPECT_GT(dot(plain->normalCone(0).axis, at(*plain, {0.2f, 0.2f}).n), 0.9999f);
    }
  }
  // Vertex normals on both sides: the geometric normal may be either.
  const auto twisted =
      makeShape("trianglemesh",
                triangle().points("N", {{0, 0, 1}, {0, 0, 1}, {0, 0, -1}}, ParameterType::Normal));
  EXPECT_EQ(twisted->normalCone(0).cosTheta, -1);
}

TEST(TriangleMesh, ShadingFrame) {
  const Vec3 n = normalize(Vec3(0.2f, 0.3f, 1));
  const auto mesh =
      makeShape("trianglemesh", triangle().points("N", {n, n, n}, ParameterType::Normal));
  const SurfaceInteraction s = at(*mesh, {0.2f, 0.2f});
  EXPECT_LT(distance(s.shading.n, n), 1e-6f);
  EXPECT_NEAR(length(s.shading.dpdu), 1, 1e-6f);
  EXPECT_NEAR(length(s.shading.dpdv), 1, 1e-6f);
  // As in pbrt-v3: against dpdu, projected.
  EXPECT_LT(dot(s.shading.dpdu, normalize(s.dpdu)), -0.9f);
  const auto withS = makeShape(
      "trianglemesh", triangle()
                          .points("N", {n, n, n}, ParameterType::Normal)
                          .points("S", std::vector<Vec3>(3, {0, 1, 0}), ParameterType::Vector3));
  EXPECT_LT(dot(at(*withS, {0.2f, 0.2f}).shading.dpdu, Vec3(0, 1, 0)), -0.9f);
  // A tangent along the normal is no tangent; a zero normal is none.
  const auto bad = makeShape("trianglemesh", triangle()
                                                 .points("N", {n, n, n}, ParameterType::Normal)
                                                 .points("S", {n, n, n}, ParameterType::Vector3));
  EXPECT_NEAR(dot(at(*bad, {0.2f, 0.2f}).shading.dpdu, n), 0, 1e-5f);
  const auto flat = makeShape(
      "trianglemesh", triangle().points("N", std::vector<Vec3>(3, Vec3(0)), ParameterType::Normal));
  EXPECT_EQ(at(*flat, {0.2f, 0.2f}).shading.n, at(*flat, {0.2f, 0.2f}).n);
}

TEST(TriangleMesh, SamplesAreUniform) {
  const auto mesh = makeShape("trianglemesh", triangle(), Transform::scale({1, -2, 3}));
  EXPECT_NEAR(mesh->area(0), 0.5f * length(cross(Vec3(2, 0, 0), Vec3(0, -6, 1.5f))), 1e-5f);
  constexpr int kCells = 8;
  std::vector<double> observed(2 * kCells * kCells), expected(2 * kCells * kCells);
  const Vec3 p0(0, 0, 3), e1(2, 0, 0), e2(0, -6, 1.5f);
  for (uint64_t i = 0; i < 50000; ++i) {
    const auto s = mesh->sampleArea(0, {uniform(1, i, 0), uniform(1, i, 1)});
    ASSERT_TRUE(s);
    EXPECT_FLOAT_EQ(s->pdf, 1 / mesh->area(0));
    const float b1 = dot(s->p - p0, e1) / dot(e1, e1), b2 = dot(s->p - p0, e2) / dot(e2, e2);
    EXPECT_LT(distance(s->p, p0 + b1 * e1 + b2 * e2), 1e-5f);
    const int x = std::clamp(static_cast<int>(b1 * kCells), 0, kCells - 1);
    const int y = std::clamp(static_cast<int>(b2 * kCells), 0, kCells - 1);
    // Each square of the grid is two small triangles.
    const bool upper =
        b1 * kCells - static_cast<float>(x) + b2 * kCells - static_cast<float>(y) > 1;
    ++observed[static_cast<size_t>(2 * (y * kCells + x) + (upper ? 1 : 0))];
  }
  for (int y = 0; y < kCells; ++y)
    for (int x = 0; x < kCells; ++x)
      for (int half = 0; half < 2; ++half)
        expected[static_cast<size_t>(2 * (y * kCells + x) + half)] =
            x + y + half < kCells ? 50000. / (kCells * kCells) : 1e-3;
  EXPECT_EQ(chiSquareTest(observed, expected), "");
}

TEST(TriangleMesh, SolidAngleDensityIsConsistent) {
  const auto mesh = makeShape("trianglemesh", triangle());
  const Vec3 from(0.4f, -0.5f, 2.5f);
  std::vector<double> values;
  for (uint64_t i = 0; i < 20000; ++i) {
    const auto s = mesh->sampleSolidAngle(0, from, {uniform(2, i, 0), uniform(2, i, 1)});
    ASSERT_TRUE(s);
    EXPECT_FLOAT_EQ(s->pdf, mesh->pdfSolidAngle(0, from, s->p, s->n));
    values.push_back(1 / static_cast<double>(s->pdf));
  }
  // Van Oosterom and Strackee 1983.
  const Vec3 a = normalize(kCorners[0] - from), b = normalize(kCorners[1] - from),
             c = normalize(kCorners[2] - from);
  const double omega = 2 * std::atan2(std::abs(static_cast<double>(dot(a, cross(b, c)))),
                                      1 + static_cast<double>(dot(a, b) + dot(b, c) + dot(c, a)));
  EXPECT_EQ(meanTest(values, omega, 1e-5), "");
}

TEST(TriangleMesh, DegenerateTrianglesAreHarmless) {
  const auto mesh = makeShape("trianglemesh", Parameters()
                                                  .integers("indices", {0, 0, 1, 0, 1, 2})
                                                  .points("P", {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}}));
  for (uint32_t e = 0; e < 2; ++e) {
    EXPECT_EQ(mesh->area(e), 0);
    EXPECT_FALSE(mesh->sampleArea(e, {0.3f, 0.3f}));
    EXPECT_EQ(mesh->pdfSolidAngle(e, {5, 0, 0}, {1, 1, 1}, {0, 0, 1}), 0);
    SurfaceInteraction s;
    mesh->surface(e, {1, {0.3f, 0.3f}}, Ray{{0, 0, 5}, {0, 0, -1}}, SurfaceDetail::Full, s);
    EXPECT_NEAR(length(s.n), 1, 1e-6f);
    EXPECT_GT(length(cross(s.dpdu, s.dpdv)), 0);
  }
}

TEST(TriangleMesh, StorageIsReadableBeyondTheLastVertex) {
  const auto shape = makeShape("trianglemesh", triangle());
  const auto& mesh = dynamic_cast<const TriangleMesh&>(*shape);
  EXPECT_EQ(mesh.triangles().vertexCount, 3u);
  EXPECT_GE(mesh.data().positions.size(), 4u);
}

TEST(TriangleMesh, BrokenInputIsRefused) {
  const auto has = [](const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
  };
  EXPECT_TRUE(has(errorOf({}), "positions"));
  EXPECT_TRUE(has(errorOf(Parameters().points("P", kCorners)), "triangles"));
  EXPECT_TRUE(has(errorOf(Parameters().points("P", kCorners).integers("indices", {0, 1})),
                  "multiple of 3"));
  const std::string beyond =
      errorOf(Parameters().points("P", kCorners).integers("indices", {0, 1, 7}));
  EXPECT_TRUE(has(beyond, "index 7") && has(beyond, "3 vertices")) << beyond;
  EXPECT_TRUE(
      has(errorOf(Parameters().points("P", kCorners).integers("indices", {0, 1, -1})), "negative"));
  EXPECT_TRUE(has(errorOf(triangle().points("N", {{0, 0, 1}}, ParameterType::Normal)), "N"));
  EXPECT_TRUE(has(errorOf(triangle().floats("uv", {0, 0})), "uv"));
  EXPECT_TRUE(has(errorOf(triangle(), Transform::scale(Vec3(3e38f))), "not finite"));
  // From files: positions must be finite, other values count as absent.
  Build build;
  TriangleMeshData data{{0, 1, 2}, kCorners, {{NAN, 0, 1}, {0, 0, 1}, {0, 0, 1}}, {}, {}};
  const auto mesh = makeTriangleMesh(data, build.context(), "test");
  EXPECT_EQ(build.warnings.size(), 1u);
  EXPECT_EQ(at(*mesh, {0.3f, 0.3f}).shading.n, Vec3(0, 0, 1));
  data.positions[1].y = NAN;
  try {
    makeTriangleMesh(data, build.context(), "test");
    FAIL();
  } catch (const SceneError& e) {
    EXPECT_TRUE(has(e.what(), "vertex 1 is not finite"));
  }
}

}  // namespace
}  // namespace lampyris::test
