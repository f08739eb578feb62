// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "shapes/curve_segment.h"
#include "shapes/shape_helpers.h"

namespace lampyris::test {
namespace {

using DVec3 = glm::dvec3;

Parameters straight(const char* type = "flat") {
  return Parameters()
      .text("type", type)
      .floats("width", {0.2f})
      .points("P", {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}});
}

std::optional<AnyHit> down(const Shape& shape, float x, float y) {
  return bruteForce(shape, {{x, y, 5}, {0, 0, -2}});
}

SurfaceInteraction surfaceAt(const Shape& shape, const Ray& ray) {
  const auto hit = bruteForce(shape, ray);
  EXPECT_TRUE(hit);
  SurfaceInteraction s;
  if (hit) shape.surface(hit->element, hit->hit, ray, SurfaceDetail::Full, s);
  return s;
}

TEST(Curve, AStraightOneIsAStrip) {
  const auto shape = makeShape("curve", straight());
  EXPECT_EQ(shape->elementCount(), 8u);
  for (const float y : {-0.0999f, -0.03f, 0.f, 0.07f, 0.0999f}) {
    const auto hit = down(*shape, 2.25f, y);
    ASSERT_TRUE(hit) << y;
    EXPECT_NEAR(hit->hit.t, 2.5f, 1e-6f);
    EXPECT_NEAR(hit->hit.uv.x, 0.75f, 1e-5f);
    // Seen from above v runs to the left of the curve's direction: with the ray along z it is y.
    EXPECT_NEAR(hit->hit.uv.y, 0.5f - y / 0.2f, 1e-4f) << y;
  }
  EXPECT_FALSE(down(*shape, 2.25f, 0.1001f));
  EXPECT_FALSE(down(*shape, 2.25f, -0.1001f));
  EXPECT_FALSE(down(*shape, -0.001f, 0));
  EXPECT_FALSE(down(*shape, 3.001f, 0));
  EXPECT_FALSE(bruteForce(*shape, {{1, 0, 5}, {0, 0, -2}, 2.49f}));
}

TEST(Curve, SurfacesHaveTheFrameOfTheStrip) {
  const Ray ray{{2.25f, 0.05f, 5}, {0, 0, -2}};
  const SurfaceInteraction flat = surfaceAt(*makeShape("curve", straight()), ray);
  EXPECT_LT(distance(flat.dpdu, {3, 0, 0}), 1e-5f);
  EXPECT_LT(distance(flat.dpdv, {0, -0.2f, 0}), 1e-6f);
  EXPECT_LT(distance(flat.n, {0, 0, -1}), 1e-6f);
  EXPECT_LT(distance(flat.p, ray.at(2.5f)), 1e-6f);
  EXPECT_GE(std::min({flat.pError.x, flat.pError.y, flat.pError.z}), 0.2f);
  // Half way to the side a tube looks 45° up.
  const SurfaceInteraction tube = surfaceAt(*makeShape("curve", straight("cylinder")), ray);
  EXPECT_NEAR(std::abs(tube.n.z), std::sqrt(0.5f), 1e-4f);
  EXPECT_NEAR(std::abs(tube.n.y), std::sqrt(0.5f), 1e-4f);
  EXPECT_NEAR(length(tube.dpdv), 0.2f, 1e-6f);
  Build build;
  const auto reversed = build.make("curve", straight(), {}, true);
  EXPECT_LT(distance(surfaceAt(*reversed, ray).n, {0, 0, 1}), 1e-6f);
}

TEST(Curve, RibbonsNarrow) {
  const auto ribbon = makeShape(
      "curve", straight("ribbon").points("N", {{0, 0, 5}, {0, 3, 0}}, ParameterType::Normal));
  // At u the normal is turned by u · 90°.
  for (const float u : {0.1f, 0.5f, 0.8f}) {
    const float half = 0.1f * std::cos(u * kPi / 2);
    const auto hit = down(*ribbon, 3 * u, 0.99f * half);
    ASSERT_TRUE(hit) << u;
    EXPECT_NEAR(hit->hit.uv.y, 0.5f - 0.495f, 1e-3f);
    EXPECT_FALSE(down(*ribbon, 3 * u, 1.01f * half)) << u;
    const Ray ray{{3 * u, 0, 5}, {0, 0, -1}};
    const SurfaceInteraction s = surfaceAt(*ribbon, ray);
    EXPECT_NEAR(absDot(s.n, {0, std::sin(u * kPi / 2), std::cos(u * kPi / 2)}), 1, 1e-5f);
  }
  // Equal normals: no arc between them.
  const auto level = makeShape(
      "curve", straight("ribbon").points("N", {{0, 0, 1}, {0, 0, 1}}, ParameterType::Normal));
  EXPECT_TRUE(down(*level, 1, 0.09f));
  EXPECT_FALSE(bruteForce(*level, {{1, -5, 0}, {0, 1, 0}}));
}

/// All places at which the ray passes a piece's middle perpendicularly, by brute force: depth and
/// distance.
std::optional<double> nearestPass(const CubicBezier& c, double width, const DVec3& o,
                                  const DVec3& w, bool& doubtful) {
  constexpr int kSteps = 4000;
  std::optional<double> nearest;
  const auto across = [&](double t) {
    const DVec3 d = c.point(t) - o;
    return d - glm::dot(d, w) * w;
  };
  double before = glm::dot(across(0), c.derivative(0));
  doubtful = std::abs(before) < 1e-2;
  for (int i = 1; i <= kSteps; ++i) {
    const double t = static_cast<double>(i) / kSteps;
    const double slope = glm::dot(across(t), c.derivative(t));
    if (before <= 0 && slope > 0) {
      const double far = glm::length(across(t - 0.5 / kSteps));
      const double z = glm::dot(c.point(t) - o, w);
      if (std::abs(far - width / 2) < 0.02 * width) doubtful = true;
      if (far < width / 2 && z > 0 && (!nearest || z < *nearest)) nearest = z;
    }
    before = slope;
  }
  doubtful = doubtful || std::abs(before) < 1e-2;
  return nearest;
}

TEST(Curve, FindsWhatExhaustiveSearchFinds) {
  int hits = 0, doubts = 0;
  for (uint64_t i = 0; i < 3000; ++i) {
    const Bounds3 box(Vec3(-1), Vec3(1));
    CurveSegment s;
    for (uint32_t k = 0; k < 4; ++k) s.curve.p[k] = DVec3(randomPoint(box, 21, i, 3 * k));
    s.startWidth = s.endWidth = 0.05 + 0.2 * static_cast<double>(uniform(21, i, 12));
    const DVec3 w(randomDirection(21, i, 13));
    const DVec3 target = s.curve.point(static_cast<double>(uniform(21, i, 15)));
    const DVec3 o = target - 3. * w + 0.6 * s.startWidth * DVec3(randomDirection(21, i, 16));
    bool doubtful = false;
    const auto expected = nearestPass(s.curve, s.startWidth, o, w, doubtful);
    const auto hit = s.intersect(0, 1, o, w, 1e9);
    // Two passes close to each other, in sharp bends, may be taken for one.
    const bool same =
        hit.has_value() == expected.has_value() && (!hit || std::abs(hit->z - *expected) < 5e-3);
    doubts += doubtful || !same;
    hits += hit.has_value();
    if (!doubtful && hit.has_value() && expected.has_value()) {
      EXPECT_GE(hit->z, *expected - 0.5 * s.startWidth);
      EXPECT_TRUE(hit->v >= 0 && hit->v <= 1 && hit->u >= 0 && hit->u <= 1);
    }
  }
  EXPECT_GT(hits, 1000);
  EXPECT_LT(doubts, 300);
}

TEST(Curve, PiecesHaveNoGapsAndStayInTheirBoxes) {
  const std::vector<Vec3> points = {{-1, 0, 0}, {-0.5f, 0, 1.5f}, {0.5f, 0.3f, -1}, {1, 0, 0.8f}};
  for (const float scale : {1e-4f, 1.f, 1e4f}) {
    const Transform map = Transform::translate(scale * Vec3(3, 1, -2)) *
                          Transform::rotate(40, {1, 2, 3}) * Transform::scale(Vec3(scale));
    Parameters p;
    p.points("P", points)
        .floats("width0", {0.1f})
        .floats("width1", {0.02f})
        .floats("splitdepth", {4});
    const auto shape = makeShape("curve", p, map);
    ASSERT_EQ(shape->elementCount(), 16u);
    CubicBezier curve{{DVec3(points[0]), DVec3(points[1]), DVec3(points[2]), DVec3(points[3])}};
    for (uint64_t i = 0; i < 2000; ++i) {
      const float u = 0.01f + 0.98f * uniform(22, i, 0);
      const Vec3 target = map.point(Vec3(curve.point(u)));
      const Vec3 w = randomDirection(22, i, 1);
      const Ray ray{target - 10 * scale * w, w};
      const auto hit = bruteForce(*shape, ray);
      ASSERT_TRUE(hit) << i;
      Bounds3 box = shape->bounds(hit->element);
      box.min -= Vec3(1e-5f * scale);
      box.max += Vec3(1e-5f * scale);
      EXPECT_TRUE(box.contains(ray.at(hit->hit.t)));
      SurfaceInteraction s;
      shape->surface(hit->element, hit->hit, ray, SurfaceDetail::Basic, s);
      EXPECT_NEAR(length(s.n), 1, 1e-5f);
      EXPECT_GT(length(cross(s.dpdu, s.dpdv)), 0);
    }
  }
}

TEST(Curve, BasesAndDegreesDescribeTheSameCurves) {
  // A uniform B-spline reproduces lines, and quadratics are what their Bézier form says.
  const std::vector<Vec3> line = {{0, 0, 0}, {1, 2, 3}, {2, 4, 6}, {3, 6, 9}, {4, 8, 12}};
  for (const size_t degree : {2u, 3u}) {
    ASSERT_EQ(curveSegmentCount(5, degree, CurveBasis::BSpline), 5 - degree);
    for (size_t i = 0; i < 5 - degree; ++i) {
      const CubicBezier c = curveSegment(line, i, degree, CurveBasis::BSpline);
      const double start = static_cast<double>(i) + static_cast<double>(degree - 1) / 2;
      for (const double t : {0., 0.25, 1.})
        EXPECT_LT(glm::length(c.point(t) - (start + t) * DVec3(1, 2, 3)), 1e-6);
    }
  }
  const std::vector<Vec3> bent = {{0, 0, 0}, {1, 3, 0}, {4, 1, 2}, {5, 5, 5}, {0, 2, 9}};
  const CubicBezier quadratic = curveSegment(bent, 1, 2, CurveBasis::Bezier);
  const DVec3 middle = 0.25 * DVec3(bent[2]) + 0.5 * DVec3(bent[3]) + 0.25 * DVec3(bent[4]);
  EXPECT_LT(glm::length(quadratic.point(0.5) - middle), 1e-6);
  // Neighbouring pieces of B-splines share position and slope.
  for (const size_t degree : {2u, 3u}) {
    const CubicBezier a = curveSegment(bent, 0, degree, CurveBasis::BSpline);
    const CubicBezier b = curveSegment(bent, 1, degree, CurveBasis::BSpline);
    EXPECT_LT(glm::length(a.point(1) - b.point(0)), 1e-6);
    EXPECT_LT(glm::length(a.derivative(1) - b.derivative(0)), 1e-6);
  }
}

TEST(Curve, BrokenInputIsRefusedOrHarmless) {
  EXPECT_THROW(makeShape("curve", {}), SceneError);
  const auto with = [](size_t count) {
    return Parameters().points("P", std::vector<Vec3>(count, Vec3(1, 2, 3)));
  };
  EXPECT_THROW(makeShape("curve", with(5)), SceneError);
  EXPECT_THROW(makeShape("curve", with(4).text("type", "ribbon")), SceneError);
  EXPECT_THROW(makeShape("curve", with(4).integers("degree", {4})), SceneError);
  EXPECT_THROW(makeShape("curve", with(4).floats("splitdepth", {40})), SceneError);
  EXPECT_THROW(makeShape("curve", with(4).floats("width", {-1})), SceneError);
  EXPECT_THROW(makeShape("curve", Parameters().points("P", {Vec3(0), Vec3(1), Vec3(NAN), Vec3(2)})),
               SceneError);
  EXPECT_THROW(makeShape("curve", straight("ribbon").points("N", {{0, 0, 0}, {0, 1, 0}},
                                                            ParameterType::Normal)),
               SceneError);
  // All points in one place, and a curve along the ray.
  const auto dot = makeShape("curve", with(4));
  const Ray at{{1, 2, 9}, {0, 0, -1}};
  if (bruteForce(*dot, at)) {
    const SurfaceInteraction s = surfaceAt(*dot, at);
    EXPECT_TRUE(isFinite(s.n) && isFinite(s.dpdu) && isFinite(s.dpdv));
  }
  const Ray along{{-5, 0, 0}, {1, 0, 0}};
  if (bruteForce(*makeShape("curve", straight()), along)) {
    const SurfaceInteraction s = surfaceAt(*makeShape("curve", straight()), along);
    EXPECT_TRUE(isFinite(s.n) && isFinite(s.dpdu) && isFinite(s.dpdv));
  }
  EXPECT_FALSE(down(*makeShape("curve", straight().floats("width", {0})), 1, 0));
}

TEST(Curve, ItsLightIsFoundByRaysOnly) {
  const auto shape = makeShape("curve", straight());
  double area = 0;
  for (uint32_t e = 0; e < shape->elementCount(); ++e) area += static_cast<double>(shape->area(e));
  EXPECT_NEAR(area, 0.6, 1e-5);
  EXPECT_FALSE(shape->sampleSolidAngle(0, {0, 0, 5}, {0.5f, 0.5f}));
  EXPECT_EQ(shape->pdfSolidAngle(0, {0, 0, 5}, {0, 0, 0}, {0, 0, 1}), 0);
}

}  // namespace
}  // namespace lampyris::test
