// SPDX-License-Identifier: Apache-2.0
#include "shapes/spherical_triangle.h"

#include <gtest/gtest.h>

#include "shapes/shape_helpers.h"

namespace lampyris::test {
namespace {

using DVec3 = glm::dvec3;
using LVec3 = glm::vec<3, long double>;

/// A triangle as seen from a point.
struct View {
  const char* name;
  std::array<Vec3, 3> corners;
  Vec3 from;
};

const std::vector<View>& views() {
  static const std::vector<View> all = {
      {"ordinary", {{{0, 0, 1}, {2, 0, 1}, {0, 3, 1.5f}}}, {0.4f, -0.5f, 2.5f}},
      {"octant", {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}}, {0, 0, 0}},
      {"near", {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}, {0.3f, 0.3f, 0.02f}},
      {"nearly a hemisphere", {{{-1, -1, 0}, {1, -1, 0}, {0, 1, 0}}}, {0, -0.2f, 1e-4f}},
      {"needle", {{{0, 0, 0}, {1, 0, 0}, {0.7f, 1e-4f, 0}}}, {0.4f, 0.2f, 0.3f}},
      {"needle that points here", {{{0, 0, 0}, {1e-3f, 0, 0}, {0, 0, 9}}}, {0.2f, 0.3f, 10}},
      {"almost in the plane", {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}, {1.2f, 0.9f, 1e-5f}},
      {"above an edge", {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}, {0.5f, 0, 1e-3f}},
      {"above a corner", {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}, {0, 1, 1e-3f}},
      {"behind", {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}, {0.2f, 0.5f, -0.4f}},
      {"far", {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}, {2000, 3000, 5000}},
  };
  return all;
}

long double angle(const LVec3& a, const LVec3& b) {
  return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

/// L'Huilier's theorem, by the sides.
long double solidAngleBySides(const LVec3& p, const LVec3& q, const LVec3& r) {
  const long double a = angle(q, r), b = angle(r, p), c = angle(p, q), s = (a + b + c) / 2;
  const long double product =
      std::tan(s / 2) * std::tan((s - a) / 2) * std::tan((s - b) / 2) * std::tan((s - c) / 2);
  return 4 * std::atan(std::sqrt(std::max(product, 0.L)));
}

SphericalTriangle seen(const View& v, double scale = 1) {
  const DVec3 a = scale * (DVec3(v.corners[0]) - DVec3(v.from)),
              b = scale * (DVec3(v.corners[1]) - DVec3(v.from)),
              c = scale * (DVec3(v.corners[2]) - DVec3(v.from));
  return {SeenCorner(a), SeenCorner(b), SeenCorner(c),
          std::abs(glm::dot(a, glm::cross(b - a, c - a)))};
}

Vec3 sample(const SphericalTriangle& t, const Vec2& u) {
  return t.sample(HalfAngle::ofSolidAngle(u.x * t.solidAngle()), u.y);
}

TEST(SphericalTriangle, SolidAngle) {
  for (const View& v : views()) {
    const LVec3 o(v.from);
    const auto expected = static_cast<double>(solidAngleBySides(
        LVec3(v.corners[0]) - o, LVec3(v.corners[1]) - o, LVec3(v.corners[2]) - o));
    for (const double scale : {1e-4, 1., 1e4})
      EXPECT_NEAR(seen(v, scale).solidAngle() / expected, 1, 2e-6) << v.name;
  }
  EXPECT_NEAR(seen(views()[1]).solidAngle(), kPi / 2, 1e-6);
  EXPECT_NEAR(seen(views()[3]).solidAngle(), 2 * kPi, 1e-3);
}

TEST(SphericalTriangle, SolidAngleVanishesInThePlane) {
  for (const Vec3 from : {Vec3(0), Vec3(0.5f, 0, 0), Vec3(0.3f, 0.3f, 0), Vec3(4, 0, 0)})
    EXPECT_EQ(seen({"", {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}, from}).solidAngle(), 0);
}

/// Cells are the parts of a regular division of the triangle, each of which is a triangle.
TEST(SphericalTriangle, DirectionsAreUniform) {
  constexpr int kCells = 6, kSamples = 40000;
  for (const View& v : views()) {
    SCOPED_TRACE(v.name);
    const SphericalTriangle t = seen(v);
    const auto index = [](int i, int j, bool upper) {
      return static_cast<size_t>(2 * (j * kCells + i) + (upper ? 1 : 0));
    };
    std::vector<double> observed(2 * kCells * kCells), expected(2 * kCells * kCells);
    for (uint64_t k = 0; k < kSamples; ++k) {
      const Vec3 b = sample(t, {uniform(3, k, 0), uniform(3, k, 1)});
      ASSERT_TRUE(b.x >= 0 && b.y >= 0 && b.z >= 0);
      ASSERT_NEAR(b.x + b.y + b.z, 1, 3e-7f);
      const float x = b.y * kCells, y = b.z * kCells;
      // Rounding must not carry a point of the outer edge to a cell that does not exist.
      const int j = std::min(static_cast<int>(y), kCells - 1);
      const int i = std::min(static_cast<int>(x), kCells - 1 - j);
      const bool upper = x - static_cast<float>(i) + y - static_cast<float>(j) > 1;
      ++observed[index(i, j, upper && i + j + 1 < kCells)];
    }
    const LVec3 a = LVec3(v.corners[0]) - LVec3(v.from),
                e1 = LVec3(v.corners[1]) - LVec3(v.corners[0]),
                e2 = LVec3(v.corners[2]) - LVec3(v.corners[0]);
    const auto node = [&](int i, int j) {
      return a + static_cast<long double>(i) / kCells * e1 +
             static_cast<long double>(j) / kCells * e2;
    };
    const double perSteradian = kSamples / static_cast<double>(t.solidAngle());
    for (int j = 0; j < kCells; ++j) {
      for (int i = 0; i + j < kCells; ++i) {
        expected[index(i, j, false)] =
            perSteradian *
            static_cast<double>(solidAngleBySides(node(i, j), node(i + 1, j), node(i, j + 1)));
        if (i + j + 1 < kCells)
          expected[index(i, j, true)] =
              perSteradian * static_cast<double>(solidAngleBySides(
                                 node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)));
      }
    }
    EXPECT_EQ(chiSquareTest(observed, expected), "");
  }
}

TEST(SphericalTriangle, ExtremeNumbersStayOnTheTriangle) {
  for (const View& v : views()) {
    const SphericalTriangle t = seen(v);
    for (const float x : {0.f, 1e-30f, 1e-7f, 0.5f, kOneMinusEpsilon}) {
      for (const float y : {0.f, 1e-30f, 1e-7f, 0.5f, kOneMinusEpsilon}) {
        const Vec3 b = sample(t, {x, y});
        EXPECT_TRUE(b.x >= 0 && b.y >= 0 && b.z >= 0) << v.name;
        EXPECT_NEAR(b.x + b.y + b.z, 1, 3e-7f) << v.name;
      }
    }
  }
}

std::unique_ptr<Shape> meshOf(const View& v, float scale) {
  const std::vector<Vec3> points = {scale * v.corners[0], scale * v.corners[1],
                                    scale * v.corners[2]};
  return makeShape("trianglemesh", Parameters().integers("indices", {0, 1, 2}).points("P", points));
}

TEST(TriangleSampling, DensitiesAgreeAndIntegrateToOne) {
  for (const View& v : views()) {
    for (const float scale : {1e-4f, 1.f, 1e4f}) {
      SCOPED_TRACE(v.name);
      const auto mesh = meshOf(v, scale);
      const Vec3 from = scale * v.from;
      std::vector<double> inverse;
      for (uint64_t i = 0; i < 4000; ++i) {
        const auto s = mesh->sampleSolidAngle(0, from, {uniform(4, i, 0), uniform(4, i, 1)});
        ASSERT_TRUE(s);
        EXPECT_FLOAT_EQ(s->pdf, mesh->pdfSolidAngle(0, from, s->p, s->n));
        EXPECT_FLOAT_EQ(s->pdf, mesh->pdfSolidAngle(0, from, s->p, -s->n));
        inverse.push_back(1 / static_cast<double>(s->pdf));
        // On the triangle: within the error of the point.
        const Vec3 e1 = scale * (v.corners[1] - v.corners[0]);
        const Vec3 e2 = scale * (v.corners[2] - v.corners[0]);
        const Vec3 n = normalize(cross(e1, e2));
        EXPECT_LE(std::abs(dot(n, s->p - scale * v.corners[0])),
                  2 * dot(glm::abs(n), s->pError) + 1e-6f * scale);
      }
      const double omega = seen(v).solidAngle();
      EXPECT_EQ(meanTest(inverse, omega, 2e-5 * omega), "");
    }
  }
}

/// What multiple importance sampling needs: the density at the points that directions find.
TEST(TriangleSampling, DensityOverTracedDirectionsIsOne) {
  for (const size_t i : {0, 1, 2, 9}) {
    const View& v = views()[i];
    for (const float away : {0.f, 2.f}) {  // both branches
      const auto mesh = meshOf(v, 1);
      const Vec3 centre = (v.corners[0] + v.corners[1] + v.corners[2]) / 3.f;
      const Vec3 from = v.from + away * (v.from - centre);
      std::vector<double> values;
      for (uint64_t k = 0; k < 60000; ++k) {
        const Ray ray{from, randomDirection(5, k, 0)};
        const auto hit = mesh->intersect(0, ray);
        double pdf = 0;
        if (hit) {
          SurfaceInteraction at;
          mesh->surface(0, *hit, ray, SurfaceDetail::Basic, at);
          pdf = static_cast<double>(mesh->pdfSolidAngle(0, from, at.p, at.n));
        }
        values.push_back(4 * M_PI * pdf);
      }
      EXPECT_EQ(meanTest(values, 1), "") << v.name << away;
    }
  }
}

/// Lambert's formula for the irradiance of a polygon of radiance 1 above the horizon.
double lambertIrradiance(const std::array<Vec3, 3>& corners, const Vec3& from, const Vec3& n) {
  double sum = 0;
  for (size_t i = 0; i < 3; ++i) {
    const DVec3 p = DVec3(corners[i]) - DVec3(from), q = DVec3(corners[(i + 1) % 3]) - DVec3(from);
    const DVec3 side = glm::cross(p, q);
    sum += std::atan2(glm::length(side), glm::dot(p, q)) * glm::dot(DVec3(n), side) /
           glm::length(side);
  }
  return std::abs(sum) / 2;
}

TEST(TriangleSampling, IrradianceIsLambertsFormula) {
  const std::array<Vec3, 3> corners = {{{-1, -0.5f, 2}, {1.5f, -1, 2.5f}, {0.2f, 1.4f, 1.8f}}};
  const View v{"", corners, {}};
  for (const float scale : {1e-4f, 1.f, 1e4f}) {
    const auto mesh = meshOf(v, scale);
    // From almost touching to where the triangle is sampled by area.
    for (const Vec3 at : {Vec3(0.2f, 0, 1.7f), Vec3(0, 0, 1), Vec3(0), Vec3(0.5f, 1, -10)}) {
      const Vec3 parallel = cross(corners[1] - corners[0], corners[2] - corners[0]);
      const Vec3 n =
          normalize(at.z > 1.5f ? faceForward(parallel, corners[0] - at) : Vec3(0.1f, -0.2f, 1));
      for (const Vec3& p : corners) ASSERT_GT(dot(p - at, n), 0);
      std::vector<double> values;
      for (uint64_t i = 0; i < 20000; ++i) {
        const auto s = mesh->sampleSolidAngle(0, scale * at, {uniform(6, i, 0), uniform(6, i, 1)});
        ASSERT_TRUE(s);
        values.push_back(static_cast<double>(dot(normalize(s->p - scale * at), n) / s->pdf));
      }
      const double expected = lambertIrradiance(corners, at, n);
      EXPECT_EQ(meanTest(values, expected, 2e-5 * expected), "") << at.z << " " << scale;
    }
  }
}

TEST(TriangleSampling, OnTheTriangleNothingGoesWrong) {
  const View v{"", {{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}}, {}};
  const auto mesh = meshOf(v, 1);
  for (const Vec3 from : {Vec3(0), Vec3(0.5f, 0, 0), Vec3(0.3f, 0.3f, 0), Vec3(1, 1, 0),
                          Vec3(0.3f, 0.3f, 1e-30f), Vec3(0, 0, 1e-30f), Vec3(90, 0, 1e-30f)}) {
    for (uint64_t i = 0; i < 100; ++i) {
      const auto s = mesh->sampleSolidAngle(0, from, {uniform(7, i, 0), uniform(7, i, 1)});
      if (s) {
        EXPECT_TRUE(s->pdf > 0 && std::isfinite(s->pdf) && isFinite(s->p));
        EXPECT_FLOAT_EQ(s->pdf, mesh->pdfSolidAngle(0, from, s->p, s->n));
      }
    }
    const float pdf = mesh->pdfSolidAngle(0, from, {0.2f, 0.2f, 0}, {0, 0, 1});
    EXPECT_TRUE(pdf >= 0 && std::isfinite(pdf));
  }
}

}  // namespace
}  // namespace lampyris::test
