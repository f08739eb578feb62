// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "core/sampling.h"
#include "shapes/quadric_cases.h"

namespace lampyris::test {
namespace {

/// Values whose mean is the area, by Crofton's formula: a line of random direction and position
/// meets a piece of surface as often as half its area says.
std::vector<double> croftonArea(const Shape& shape) {
  const Bounds3 box = shape.bounds(0);
  const float radius = 0.51f * box.diagonal();
  const double perCrossing = 2 * M_PI * static_cast<double>(radius) * static_cast<double>(radius);
  std::vector<double> values;
  for (uint64_t i = 0; i < 60000; ++i) {
    const Vec3 w = randomDirection(11, i, 0);
    const Frame frame = Frame::fromZ(w);
    const Vec2 q = radius * sampleConcentricDisk({uniform(11, i, 2), uniform(11, i, 3)});
    Ray ray{box.centroid() + q.x * frame.x + q.y * frame.y - 2 * radius * w, w};
    int crossings = 0;
    while (const auto hit = shape.intersect(0, ray)) {
      ++crossings;
      ray.o = ray.at(hit->t) + 1e-4f * radius * w;
    }
    values.push_back(crossings * perCrossing);
  }
  return values;
}

TEST(QuadricSampling, AreaIsWhatRandomLinesMeasure) {
  for (const QuadricCase& c : quadricCases()) {
    if (c.reverse) continue;
    const auto shape = c.make();
    const auto area = static_cast<double>(shape->area(0));
    EXPECT_EQ(meanTest(croftonArea(*shape), area, 1e-3 * area), "") << c.name;
  }
}

TEST(QuadricSampling, AreaHasItsClosedForm) {
  EXPECT_FLOAT_EQ(makeShape("sphere", {})->area(0), 4 * kPi);
  EXPECT_FLOAT_EQ(makeShape("sphere", {}, Transform::scale({-3, 3, 3}))->area(0), 36 * kPi);
  EXPECT_NEAR(makeShape("disk", {}, Transform::scale({2, 3, 5}))->area(0), 6 * kPi, 1e-4f);
  // A spheroid of half-axes 1, 1, c > 1: 2π (1 + c asin(e) / e).
  const double c = 2, e = std::sqrt(1 - 1 / (c * c));
  EXPECT_NEAR(makeShape("sphere", {}, Transform::scale({1, 1, 2}))->area(0),
              2 * M_PI * (1 + c * std::asin(e) / e), 1e-4);
  EXPECT_FLOAT_EQ(makeShape("cone", {})->area(0), kPi * std::sqrt(2.f));
  EXPECT_NEAR(makeShape("paraboloid", {})->area(0), M_PI / 6 * (5 * std::sqrt(5.) - 1), 1e-5);
  // A flat paraboloid is a disk.
  EXPECT_NEAR(makeShape("paraboloid", Parameters().floats("zmax", {1e-6f}))->area(0), kPi, 1e-5f);
}

/// Where a sample says it is; nowhere at a cut's edge, which rounding may carry it past.
std::optional<ShapeHit> hitAt(const Shape& shape, const ShapeSample& s) {
  return shape.locate(0, s.p, s.n);
}

TEST(QuadricSampling, SamplesLieOnTheSurfaceWithTheirPdf) {
  for (const QuadricCase& c : quadricCases()) {
    SCOPED_TRACE(c.name);
    const auto shape = c.make();
    std::vector<double> inverse;
    int missed = 0;
    for (uint64_t i = 0; i < 4000; ++i) {
      const auto s = shape->sampleArea(0, {uniform(5, i, 0), uniform(5, i, 1)});
      ASSERT_TRUE(s);
      EXPECT_FLOAT_EQ(s->pdf, shape->pdfArea(0, s->n));
      EXPECT_FLOAT_EQ(s->pdf, shape->pdfArea(0, -s->n));
      inverse.push_back(1 / static_cast<double>(s->pdf));
      const auto hit = hitAt(*shape, *s);
      missed += !hit;
      if (!hit) continue;
      SurfaceInteraction at;
      shape->surface(0, *hit, Ray{}, SurfaceDetail::Basic, at);
      EXPECT_LT(distance(at.p, s->p), 1e-5f * (1 + length(s->p)));
      EXPECT_GT(dot(at.n, s->n), 0.999f);
    }
    EXPECT_LT(missed, 10);
    const auto area = static_cast<double>(shape->area(0));
    EXPECT_EQ(meanTest(inverse, area, 1e-5 * area), "");
  }
}

TEST(QuadricSampling, AreaSamplesAreDistributedByTheirPdf) {
  // Over a grid of the parameters: the expected share of a cell is the integral of pdf dA.
  constexpr int kCells = 8, kSub = 16, kSamples = 40000;
  for (const QuadricCase& c : quadricCases()) {
    if (c.reverse) continue;
    const auto shape = c.make();
    std::vector<double> observed(kCells * kCells), expected(kCells * kCells);
    for (uint64_t i = 0; i < kSamples; ++i) {
      const auto s = shape->sampleArea(0, {uniform(6, i, 0), uniform(6, i, 1)});
      const auto hit = hitAt(*shape, *s);
      if (!hit) continue;
      const int x = std::min(static_cast<int>(hit->uv.x * kCells), kCells - 1);
      const int y = std::min(static_cast<int>(hit->uv.y * kCells), kCells - 1);
      ++observed[static_cast<size_t>(y * kCells + x)];
    }
    for (int y = 0; y < kCells * kSub; ++y) {
      for (int x = 0; x < kCells * kSub; ++x) {
        const float step = 1.f / (kCells * kSub);
        SurfaceInteraction at;
        shape->surface(
            0, {1, {(static_cast<float>(x) + 0.5f) * step, (static_cast<float>(y) + 0.5f) * step}},
            Ray{}, SurfaceDetail::Basic, at);
        const float dA = length(cross(at.dpdu, at.dpdv)) * step * step;
        expected[static_cast<size_t>(y / kSub * kCells + x / kSub)] +=
            static_cast<double>(dA * shape->pdfArea(0, at.n)) * kSamples;
      }
    }
    EXPECT_EQ(chiSquareTest(observed, expected), "") << c.name;
  }
}

/// E[1 / pdf] over solid-angle samples that see their point is the solid angle; compared with the
/// share of directions that hit. Convex shapes are seen once a direction.
TEST(QuadricSampling, SolidAngleDensityIsConsistent) {
  for (const QuadricCase& c : quadricCases()) {
    SCOPED_TRACE(c.name);
    const auto shape = c.make();
    const Bounds3 box = shape->bounds(0);
    for (const float away : {0.1f, 2.f}) {
      const Vec3 from = box.centroid() + away * box.diagonal() * normalize(Vec3(0.3f, -1, 0.6f));
      std::vector<double> sampled, traced;
      for (uint64_t i = 0; i < 8000; ++i) {
        const auto s = shape->sampleSolidAngle(0, from, {uniform(7, i, 0), uniform(7, i, 1)});
        if (!s) {
          sampled.push_back(0);
          continue;
        }
        EXPECT_NEAR(s->pdf, shape->pdfSolidAngle(0, from, s->p, s->n), 1e-5f * s->pdf);
        // Count only points that nothing of the shape hides.
        const Ray ray{from, s->p - from, 0.9995f};
        const bool hidden = shape->intersect(0, ray).has_value();
        sampled.push_back(hidden ? 0 : 1 / static_cast<double>(s->pdf));
        const Ray random{from, randomDirection(7, i, 2)};
        traced.push_back(shape->intersect(0, random) ? 4 * M_PI : 0);
      }
      double sampledMean = 0;
      for (const double v : sampled) sampledMean += v / static_cast<double>(sampled.size());
      double sampledVariance = 0;
      for (const double v : sampled)
        sampledVariance += (v - sampledMean) * (v - sampledMean) /
                           static_cast<double>(sampled.size() * sampled.size());
      EXPECT_EQ(meanTest(traced, sampledMean, 6.5 * std::sqrt(sampledVariance)), "") << away;
    }
  }
}

TEST(QuadricSampling, ConesOfSpheresAreUniformAndPrecise) {
  const Transform map = Transform::translate({4, 1, -2}) * Transform::rotate(30, {0, 1, 1});
  const auto sphere = makeShape("sphere", Parameters().floats("radius", {1.5f}), map);
  const Vec3 from(1, -2, 0.5f);
  DirectionTest test;
  test.sample = [&](const Vec2& u, float, Vec3& w) {
    const auto s = sphere->sampleSolidAngle(0, from, u);
    if (!s) return false;
    w = normalize(s->p - from);
    return true;
  };
  const Vec3 axis = Vec3(4, 1, -2) - from;
  const double cosMax = std::sqrt(1 - 2.25 / static_cast<double>(dot(axis, axis)));
  test.pdf = [&](const Vec3& w) {
    return static_cast<double>(dot(w, normalize(axis))) > cosMax ? 1 / (2 * M_PI * (1 - cosMax))
                                                                 : 0.;
  };
  test.thetaCells = 10, test.phiCells = 20, test.subdivisions = 64;
  EXPECT_EQ(directionChiSquareTest(test), "");

  for (const float far : {1e2f, 1e4f, 1e7f}) {
    const auto ball = makeShape("sphere", {}, Transform::translate({0, 0, far}));
    for (uint64_t i = 0; i < 200; ++i) {
      const auto s = ball->sampleSolidAngle(0, Vec3(0), {uniform(8, i, 0), uniform(8, i, 1)});
      ASSERT_TRUE(s);
      EXPECT_NEAR(s->pdf * kPi / (far * far), 1, 1e-3f);
      EXPECT_NEAR(length(s->p - Vec3(0, 0, far)), 1, 2e-7f * far);
      EXPECT_LT(s->n.z, 1e-6f);
      EXPECT_FLOAT_EQ(ball->pdfSolidAngle(0, Vec3(0), s->p, s->n), s->pdf);
    }
    // The far side is never drawn.
    if (far < 1e6f) {
      EXPECT_EQ(ball->pdfSolidAngle(0, Vec3(0), {0, 0, far + 1}, {0, 0, 1}), 0);
    }
  }
}

TEST(QuadricSampling, InsideASphereItIsSampledByArea) {
  const auto sphere = makeShape("sphere", {}, {}, true);
  for (const Vec3 from : {Vec3(0), Vec3(0.3f, 0.2f, -0.8f)}) {
    std::vector<double> values;
    for (uint64_t i = 0; i < 20000; ++i) {
      const auto s = sphere->sampleSolidAngle(0, from, {uniform(9, i, 0), uniform(9, i, 1)});
      ASSERT_TRUE(s);
      EXPECT_GT(s->pdf, 0);
      EXPECT_FLOAT_EQ(s->pdf, sphere->pdfSolidAngle(0, from, s->p, s->n));
      values.push_back(1 / static_cast<double>(s->pdf));
    }
    EXPECT_EQ(meanTest(values, 4 * M_PI, 1e-4), "");
  }
  // On the sphere itself nothing may go wrong.
  for (uint64_t i = 0; i < 1000; ++i) {
    const auto s = sphere->sampleSolidAngle(0, {0, 0, 1}, {uniform(9, i, 0), uniform(9, i, 1)});
    if (s) {
      EXPECT_TRUE(std::isfinite(s->pdf) && s->pdf > 0 && isFinite(s->p));
    }
  }
}

TEST(QuadricSampling, AboveASphereTheConeIsStable) {
  for (const float scale : {1e-4f, 1.f, 1e4f}) {
    const auto sphere = makeShape("sphere", Parameters().floats("radius", {scale}),
                                  Transform::translate(scale * Vec3(3, -2, 1)));
    for (const float above : {1e-6f, 1e-4f, 1e-2f}) {
      const Vec3 up = normalize(Vec3(1, 2, -0.5f));
      const Vec3 centre = scale * Vec3(3, -2, 1), from = centre + scale * (1 + above) * up;
      for (uint64_t i = 0; i < 500; ++i) {
        const auto s = sphere->sampleSolidAngle(0, from, {uniform(12, i, 0), uniform(12, i, 1)});
        ASSERT_TRUE(s);
        EXPECT_FLOAT_EQ(s->pdf, sphere->pdfSolidAngle(0, from, s->p, s->n));
        EXPECT_NEAR(distance(s->p, centre) / scale, 1, 1e-6f);
        // On the cap that is seen, but for the rounding of `from`.
        EXPECT_GT(dot(s->n, from - s->p), -4e-6f * scale);
      }
    }
  }
}

TEST(QuadricSampling, DisksHaveOneNormal) {
  const auto disk = makeShape("disk", {}, Transform::scale({1, 1, -1}), true);
  EXPECT_EQ(disk->normalCone(0).cosTheta, 1);
  EXPECT_GT(dot(disk->normalCone(0).axis, disk->sampleArea(0, {0.2f, 0.3f})->n), 0.9999f);
}

}  // namespace
}  // namespace lampyris::test
