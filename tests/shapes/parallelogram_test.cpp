// SPDX-License-Identifier: Apache-2.0
#include "shapes/parallelogram.h"

#include <gtest/gtest.h>

#include "shapes/shape_helpers.h"
#include "shapes/spherical_triangle.h"

namespace lampyris::test {
namespace {

using DVec3 = glm::dvec3;

/// A mesh of two triangles and a point that sees it.
struct Quad {
  const char* name;
  std::array<Vec3, 4> corners;
  Vec3 from;

  std::unique_ptr<Shape> mesh(float scale = 1,
                              const std::vector<int32_t>& indices = {0, 1, 2, 0, 2, 3}) const {
    std::vector<Vec3> points;
    for (const Vec3& p : corners) points.push_back(scale * p);
    return makeShape("trianglemesh", Parameters().integers("indices", indices).points("P", points));
  }
  Vec3 e1() const { return corners[1] - corners[0]; }
  Vec3 e2() const { return corners[3] - corners[0]; }
};

const std::vector<Quad>& quads() {
  static const std::vector<Quad> all = {
      {"square", {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}}, {0.3f, 0.2f, 0.4f}},
      {"slanted", {{{0, 0, 1}, {2, 0, 1}, {3, 1, 2}, {1, 1, 2}}}, {0.4f, -0.5f, 2.5f}},
      {"strip", {{{0, 0, 0}, {9, 0, 0}, {9, 0.125f, 0}, {0, 0.125f, 0}}}, {2, 1, 0.5f}},
      {"nearly touched", {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}}, {0.9f, 0.2f, 1e-3f}},
      {"beside its plane", {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}}, {1.2f, 0.9f, 1e-4f}},
      {"behind", {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}}, {0.2f, 0.5f, -0.4f}},
      {"far", {{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}}, {3, 2, 5}},
  };
  return all;
}

double solidAngle(const Vec3& from, const DVec3& p, const DVec3& q, const DVec3& r) {
  const DVec3 a = p - DVec3(from), b = q - DVec3(from), c = r - DVec3(from);
  return static_cast<double>(SphericalTriangle(SeenCorner(a), SeenCorner(b), SeenCorner(c),
                                               std::abs(glm::dot(a, glm::cross(b - a, c - a))))
                                 .solidAngle());
}

/// Of a part: from (s, t) on, `width` along both edges.
double solidAngleOf(const Quad& q, double s, double t, double width) {
  const DVec3 e1(q.e1()), e2(q.e2()), p = DVec3(q.corners[0]) + s * e1 + t * e2;
  const DVec3 far = p + width * (e1 + e2);
  return solidAngle(q.from, p, p + width * e1, far) + solidAngle(q.from, p, far, p + width * e2);
}

}  // namespace

/// By solid angle where it is wide; where it is not, in proportion to d³ over the solid angle.
TEST(Parallelogram, PointsAreDrawnByTheirDensity) {
  constexpr int kCells = 8, kSamples = 40000;
  for (const Quad& q : quads()) {
    SCOPED_TRACE(q.name);
    const auto whole = q.mesh()->whole();
    ASSERT_TRUE(whole);
    std::vector<double> observed(kCells * kCells), expected(kCells * kCells), inverse;
    const Vec3 n = normalize(cross(q.e1(), q.e2()));
    const Vec3 dual1 = cross(q.e2(), n) / dot(cross(q.e2(), n), q.e1());
    const Vec3 dual2 = cross(n, q.e1()) / dot(cross(n, q.e1()), q.e2());
    for (uint64_t k = 0; k < kSamples; ++k) {
      const auto sample = whole->sampleSolidAngle(0, q.from, {uniform(3, k, 0), uniform(3, k, 1)});
      ASSERT_TRUE(sample);
      EXPECT_FLOAT_EQ(sample->pdf, whole->pdfSolidAngle(0, q.from, sample->p, sample->n));
      EXPECT_EQ(sample->n, n);
      inverse.push_back(1 / static_cast<double>(sample->pdf));
      const Vec3 d = sample->p - q.corners[0];
      const auto cell = [](float x) {
        return static_cast<size_t>(std::clamp(static_cast<int>(x * kCells), 0, kCells - 1));
      };
      ++observed[cell(dot(d, dual2)) * kCells + cell(dot(d, dual1))];
    }
    const double omega = solidAngleOf(q, 0, 0, 1);
    EXPECT_EQ(meanTest(inverse, omega, 1e-4 * omega), "");
    const bool wide = std::string_view(q.name) != "far";
    for (size_t j = 0; j < kCells; ++j)
      for (size_t i = 0; i < kCells; ++i)
        expected[j * kCells + i] =
            wide ? kSamples / omega *
                       solidAngleOf(q, static_cast<double>(i) / kCells,
                                    static_cast<double>(j) / kCells, 1. / kCells)
                 : static_cast<double>(kSamples) / (kCells * kCells);
    EXPECT_EQ(chiSquareTest(observed, expected), "");
  }
}

TEST(Parallelogram, NearbyVariatesGiveNearbyPoints) {
  for (const Quad& q : quads()) {
    const auto whole = q.mesh()->whole();
    const float reach = length(q.e1()) + length(q.e2());
    for (int i = 0; i < 1000; ++i) {
      const float x = (static_cast<float>(i) + 0.5f) / 1001;
      const auto a = whole->sampleSolidAngle(0, q.from, {x, 0.6f});
      const auto b = whole->sampleSolidAngle(0, q.from, {x + 1 / 1001.f, 0.6f});
      ASSERT_TRUE(a && b);
      EXPECT_LT(distance(a->p, b->p), 0.1f * reach) << q.name << " " << x;
    }
  }
}

TEST(Parallelogram, ScalesAndAreas) {
  for (const Quad& q : quads()) {
    for (const float scale : {1e-6f, 1.f, 1e6f}) {
      const auto mesh = q.mesh(scale);
      const auto whole = mesh->whole();
      ASSERT_TRUE(whole);
      EXPECT_FLOAT_EQ(whole->area(0), mesh->area(0) + mesh->area(1));
      const auto sample = whole->sampleArea(0, {0.25f, 0.75f});
      ASSERT_TRUE(sample);
      EXPECT_FLOAT_EQ(sample->pdf, 1 / whole->area(0));
      EXPECT_LT(distance(sample->p, scale * (q.corners[0] + 0.25f * q.e1() + 0.75f * q.e2())),
                1e-6f * scale * 10);
      const auto seen = whole->sampleSolidAngle(0, scale * q.from, {0.3f, 0.4f});
      const auto unit = q.mesh()->whole()->sampleSolidAngle(0, q.from, {0.3f, 0.4f});
      ASSERT_TRUE(seen && unit);
      EXPECT_NEAR(seen->pdf / unit->pdf, 1, 1e-4f);
    }
  }
}

TEST(Parallelogram, WhateverTheOrderOfTheCorners) {
  const Quad& q = quads()[1];
  for (const std::vector<int32_t>& order : std::vector<std::vector<int32_t>>{
           {1, 2, 0, 3, 0, 2}, {2, 0, 1, 0, 2, 3}, {0, 1, 3, 1, 2, 3}, {3, 0, 1, 3, 1, 2}}) {
    const auto whole = q.mesh(1, order)->whole();
    ASSERT_TRUE(whole);
    EXPECT_FLOAT_EQ(whole->area(0), length(cross(q.e1(), q.e2())));
    const auto mesh = q.mesh(1, order);
    EXPECT_EQ(whole->normalCone(0).axis, mesh->normalCone(0).axis);
  }
}

TEST(Parallelogram, SeenEdgeOnThereIsNothing) {
  const auto whole = quads()[0].mesh()->whole();
  for (const Vec3 from : {Vec3(0.5f, 0.5f, 0), Vec3(4, 0, 0), Vec3(0)}) {
    EXPECT_FALSE(whole->sampleSolidAngle(0, from, {0.5f, 0.5f}));
    EXPECT_EQ(whole->pdfSolidAngle(0, from, {0.2f, 0.3f, 0}, {0, 0, 1}), 0);
  }
}

TEST(Parallelogram, OthersAreTwoTriangles) {
  const Quad square = quads()[0];
  Quad other = square;
  other.corners[2] = {1.01f, 1, 0};
  EXPECT_FALSE(other.mesh()->whole()) << "no parallelogram";
  other.corners[2] = {1, 1, 0.01f};
  EXPECT_FALSE(other.mesh()->whole()) << "bent";
  EXPECT_FALSE(square.mesh(1, {0, 1, 2, 0, 3, 2})->whole()) << "fronts on both sides";
  EXPECT_FALSE(square.mesh(1, {0, 1, 2})->whole()) << "one triangle";
  EXPECT_FALSE(square.mesh(1, {0, 1, 2, 0, 1, 2})->whole()) << "the same twice";
  EXPECT_FALSE(square.mesh(1, {0, 1, 2, 0, 2, 3, 0, 1, 3})->whole()) << "three";
  EXPECT_FALSE(square.mesh(1e-20f)->whole()) << "area too small for a density";
  const auto withNormals = [&](const std::vector<Vec3>& normals) {
    const std::vector<Vec3> points(square.corners.begin(), square.corners.end());
    return makeShape("trianglemesh", Parameters()
                                         .integers("indices", {0, 1, 2, 0, 2, 3})
                                         .points("P", points)
                                         .points("N", normals, ParameterType::Normal))
        ->whole();
  };
  EXPECT_TRUE(withNormals({{0, 0, -1}, {0.1f, 0, -1}, {0, 0, -1}, {0, 0, -1}}));
  EXPECT_FALSE(withNormals({{0, 0, -1}, {0, 0, 1}, {0, 0, -1}, {0, 0, 1}}));
}

/// What multiple importance sampling needs: the density at the points that directions find.
TEST(Parallelogram, DensityOverTracedDirectionsIsOne) {
  for (const Quad& q : quads()) {
    if (std::string_view(q.name) == "beside its plane") continue;  // hardly a direction finds it
    const auto mesh = q.mesh();
    const auto whole = mesh->whole();
    std::vector<double> values;
    for (uint64_t k = 0; k < 60000; ++k) {
      const Ray ray{q.from, randomDirection(5, k, 0)};
      double pdf = 0;
      for (const uint32_t element : {0u, 1u}) {
        const auto hit = mesh->intersect(element, ray);
        if (!hit) continue;
        SurfaceInteraction at;
        mesh->surface(element, *hit, ray, SurfaceDetail::Basic, at);
        pdf = static_cast<double>(whole->pdfSolidAngle(0, q.from, at.p, at.n));
        break;
      }
      values.push_back(4 * M_PI * pdf);
    }
    EXPECT_EQ(meanTest(values, 1), "") << q.name;
  }
}

}  // namespace lampyris::test
