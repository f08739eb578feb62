// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "shapes/quadric_cases.h"

namespace lampyris::test {
namespace {

Vec3 outward(const QuadricCase& c, const Vec3& p) {
  const glm::dvec3 o(c.toWorld.inverse().point(p));
  return normalize(c.toWorld.normal(Vec3(c.outward(o))));
}

SurfaceInteraction at(const Shape& shape, const Vec2& uv) {
  SurfaceInteraction s;
  shape.surface(0, {1, uv}, Ray{}, SurfaceDetail::Full, s);
  return s;
}

TEST(QuadricSurface, HitsLieOnTheSurfaceAndAgreeWithTheRay) {
  for (const QuadricCase& c : quadricCases()) {
    SCOPED_TRACE(c.name);
    const auto shape = c.make();
    const Bounds3 box = shape->bounds(0);
    const float size = box.diagonal();
    int hits = 0;
    for (uint64_t i = 0; i < 2000; ++i) {
      Ray ray{randomPoint(box, 1, i, 0) + size * randomDirection(1, i, 3), Vec3(0)};
      ray.d = 3.f * (randomPoint(box, 1, i, 5) - ray.o);
      const auto hit = shape->intersect(0, ray);
      if (!hit) continue;
      ++hits;
      SurfaceInteraction s;
      shape->surface(0, *hit, ray, SurfaceDetail::Basic, s);
      EXPECT_LT(distance(s.p, ray.at(hit->t)), 4e-6f * (size + length(s.p)));
      EXPECT_TRUE(box.contains(s.p));
      const Vec3 o = c.toWorld.inverse().point(s.p);
      EXPECT_LT(c.distance(glm::dvec3(o)), 1e-5);
      EXPECT_NEAR(length(s.n), 1, 1e-6f);
      EXPECT_GT(dot(s.n, outward(c, s.p)) * (c.reverse ? -1 : 1), 0.999f);
      // pbrt-v3 shades hyperboloids with the normal of the turned line.
      if (c.shape != "hyperboloid") {
        EXPECT_EQ(s.n, s.shading.n);
      }
      // Beyond tMax there is nothing.
      ray.tMax = hit->t;
      EXPECT_FALSE(shape->intersect(0, ray));
    }
    EXPECT_GT(hits, 300);
  }
}

TEST(QuadricSurface, DerivativesAreThoseOfFiniteDifferences) {
  for (const QuadricCase& c : quadricCases()) {
    SCOPED_TRACE(c.name);
    const auto shape = c.make();
    for (uint64_t i = 0; i < 50; ++i) {
      const Vec2 uv(0.05f + 0.9f * uniform(2, i, 0), 0.05f + 0.9f * uniform(2, i, 1));
      const float h = 2e-3f;
      const SurfaceInteraction s = at(*shape, uv);
      const auto check = [&](const Vec2& step, const Vec3& dp, const Vec3& dn) {
        const SurfaceInteraction a = at(*shape, uv - step), b = at(*shape, uv + step);
        EXPECT_LT(distance((b.p - a.p) / (2 * h), dp), 2e-3f * (1 + length(dp)));
        EXPECT_LT(distance((b.n - a.n) / (2 * h), dn), 2e-3f * (1 + length(dn)) * (1 + length(dn)));
      };
      check({h, 0}, s.dpdu, s.dndu);
      check({0, h}, s.dpdv, s.dndv);
      // World-space cross(dpdu, dpdv), turned over as the mirror and ReverseOrientation say.
      const bool flip = c.reverse != c.toWorld.swapsHandedness();
      EXPECT_GT(dot(cross(s.dpdu, s.dpdv), s.n) * (flip ? -1 : 1), 0);
    }
  }
}

TEST(QuadricSurface, PolesAndCentresHaveAFrame) {
  const auto sphere = makeShape("sphere", {});
  const auto disk = makeShape("disk", {});
  for (const Shape* shape : {sphere.get(), disk.get()}) {
    for (const float v : {0.f, 1.f}) {
      const SurfaceInteraction s = at(*shape, {0.3f, v});
      EXPECT_GT(length(cross(s.dpdu, s.dpdv)), 0);
      EXPECT_NEAR(std::abs(s.n.z), 1, 1e-6f);
      EXPECT_TRUE(isFinite(s.dndu) && isFinite(s.dndv));
    }
  }
}

TEST(QuadricSurface, ParametersAreThoseOfPbrt) {
  Parameters p;
  p.floats("radius", {2}).floats("zmin", {-1}).floats("zmax", {1.5f}).floats("phimax", {180});
  const auto sphere = makeShape("sphere", p);
  // A ray along −x at z = 0.5, y = 0 would meet φ = 0; from −y the surface is cut away.
  const auto hit = sphere->intersect(0, {{0, 5, 0}, {0, -1, 0}});
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->t, 3, 1e-6);
  EXPECT_NEAR(hit->uv.x, 0.5f, 1e-6f);
  const float theta0 = std::acos(-0.5f), theta1 = std::acos(0.75f);
  EXPECT_NEAR(hit->uv.y, (kPi / 2 - theta0) / (theta1 - theta0), 1e-6f);
  // From below y the near half is missing: the far half is met from inside.
  const auto back = sphere->intersect(0, {{0, -5, 0}, {0, 1, 0}});
  ASSERT_TRUE(back);
  EXPECT_NEAR(back->t, 7, 1e-6);
  EXPECT_FALSE(sphere->intersect(0, {{0, 5, 1.7f}, {0, -1, 0}}));

  Parameters d;
  d.floats("radius", {2}).floats("innerradius", {1});
  const auto ring = makeShape("disk", d);
  const auto onRing = ring->intersect(0, {{0, 1.25f, 4}, {0, 0, -2}});
  ASSERT_TRUE(onRing);
  EXPECT_FLOAT_EQ(onRing->t, 2);
  EXPECT_NEAR(onRing->uv.x, 0.25f, 1e-6f);
  EXPECT_NEAR(onRing->uv.y, 0.75f, 1e-6f);
  EXPECT_FALSE(ring->intersect(0, {{0, 0.5f, 4}, {0, 0, -2}}));
}

TEST(QuadricSurface, FarRaysStayPrecise) {
  const auto sphere = makeShape("sphere", {});
  for (uint64_t i = 0; i < 1000; ++i) {
    const Vec3 w = randomDirection(3, i, 0);
    const Vec3 target = randomDirection(3, i, 2);
    const Ray ray{target - 1e5f * w, w};
    const auto hit = sphere->intersect(0, ray);
    // What the exact ray (its origin is rounded) meets, in double.
    const glm::dvec3 o(ray.o), d(ray.d);
    const glm::dvec3 foot = o - glm::dot(o, d) / glm::dot(d, d) * d;
    const double reach = 1 - glm::dot(foot, foot);
    if (std::abs(reach) > 1e-9) {
      ASSERT_EQ(hit.has_value(), reach > 0);
    }
    if (hit) {
      SurfaceInteraction s;
      sphere->surface(0, *hit, ray, SurfaceDetail::Basic, s);
      EXPECT_NEAR(length(s.p), 1, 3e-7f);
    }
  }
}

TEST(QuadricSurface, RaysThatLeaveDoNotMeetTheSurfaceAgainWhereTheyStart) {
  for (const float scale : {1e-4f, 1.f, 1e4f}) {
    for (const float far : {0.f, 1e5f}) {
      for (const QuadricCase& c : quadricCases()) {
        if (c.reverse) continue;
        SCOPED_TRACE(c.name + fmt::format(", scale {}, offset {}", scale, far));
        const Transform map = Transform::translate(far * scale * Vec3(1, -0.7f, 0.3f)) *
                              Transform::scale(Vec3(scale)) * c.toWorld;
        const auto shape = makeShape(c.shape, c.parameters, map);
        for (uint64_t i = 0; i < 500; ++i) {
          SurfaceInteraction s;
          shape->surface(0, {1, {uniform(4, i, 0), uniform(4, i, 1)}}, Ray{}, SurfaceDetail::Basic,
                         s);
          Vec3 w = randomDirection(4, i, 2);
          if (c.shape != "disk") w = faceForward(w, s.n);
          const bool convex = c.shape != "hyperboloid";
          if (std::abs(dot(w, s.n)) < (convex ? 1e-5f : 1e-2f)) continue;
          const float tMax = convex ? kInfinity : 1e-4f * shape->bounds(0).diagonal();
          const Ray ray{offsetRayOrigin(s.p, s.pError, s.n, w), w, tMax};
          EXPECT_FALSE(shape->intersect(0, ray));
        }
      }
    }
  }
}

TEST(QuadricSurface, RevolvedParametersAreThoseOfPbrt) {
  Parameters p;
  p.floats("radius", {2}).floats("height", {4}).floats("phimax", {180});
  const auto cone = makeShape("cone", p);
  const auto onCone = cone->intersect(0, {{0, 5, 1}, {0, -1, 0}});
  ASSERT_TRUE(onCone);
  EXPECT_NEAR(onCone->t, 3.5f, 1e-6f);
  EXPECT_NEAR(onCone->uv.x, 0.5f, 1e-6f);
  EXPECT_NEAR(onCone->uv.y, 0.25f, 1e-6f);
  // The other nappe is no part of it.
  EXPECT_FALSE(cone->intersect(0, {{0, 5, 5}, {0, -1, 0}}));

  Parameters q;
  q.floats("radius", {2}).floats("zmin", {1}).floats("zmax", {4});
  const auto paraboloid = makeShape("paraboloid", q);
  const auto onParaboloid = paraboloid->intersect(0, {{0, -5, 2.25f}, {0, 1, 0}});
  ASSERT_TRUE(onParaboloid);
  EXPECT_NEAR(onParaboloid->t, 3.5f, 1e-6f);
  EXPECT_NEAR(onParaboloid->uv.x, 0.75f, 1e-6f);
  EXPECT_NEAR(onParaboloid->uv.y, 1.25f / 3, 1e-6f);
  // A ray along the axis: the equation is linear.
  EXPECT_FALSE(paraboloid->intersect(0, {{0.1f, 0, 9}, {0, 0, -1}}));
  const auto along = paraboloid->intersect(0, {{1.5f, 0, 9}, {0, 0, -1}});
  ASSERT_TRUE(along);
  EXPECT_NEAR(along->t, 9 - 2.25f, 1e-6f);

  Parameters h;
  h.points("p1", {{1, -1, -1}}).points("p2", {{1, 1, 1}});
  const auto hyperboloid = makeShape("hyperboloid", h);
  // On the line itself u is 0 (or 1), wherever it stands.
  for (const float z : {-0.9f, -0.2f, 0.7f}) {
    const Vec3 target(1, z + 1e-5f, z), normal(1, z, -z);
    const auto hit = hyperboloid->intersect(0, {target + normal, -normal});
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->uv.x, 0, 1e-4f);
    EXPECT_NEAR(hit->uv.y, (z + 1) / 2, 1e-4f);
    // Symmetric about its waist: pbrt-v3's shading normal is that of the surface.
    const SurfaceInteraction s = at(*hyperboloid, hit->uv);
    EXPECT_GT(dot(s.shading.n, s.n), 0.99999f);
    EXPECT_GT(dot(s.n, normalize(normal)), 0.9999f);
  }
}

TEST(QuadricSurface, HyperboloidsAreShadedAsTheirTurnedLine) {
  Parameters p;
  p.points("p1", {{0.8f, 0, 0}}).points("p2", {{0.3f, 0.6f, 1.5f}});
  const auto shape = makeShape("hyperboloid", p);
  // At p1 the line comes nearer to the axis: 1.5 along z, −0.5 along the radius.
  const SurfaceInteraction s = at(*shape, {0, 0});
  EXPECT_LT(distance(s.shading.n, normalize(Vec3(1.5f, 0, 0.5f))), 1e-5f);
  EXPECT_LT(distance(s.n, Vec3(1, 0, 0)), 1e-5f);
}

TEST(QuadricSurface, RevolvedShapesThatAreNothing) {
  for (const float height : {0.f, -2.f})
    EXPECT_FALSE(makeShape("cone", Parameters().floats("height", {height}))
                     ->intersect(0, {{0, 5, 0.5f}, {0, -1, 0}}));
  for (const char* name : {"cone", "paraboloid"}) {
    const auto flat = makeShape(name, Parameters().floats("radius", {0}));
    EXPECT_EQ(flat->area(0), 0) << name;
    EXPECT_FALSE(flat->sampleArea(0, {0.5f, 0.5f}));
    EXPECT_TRUE(flat->bounds(0).empty());
  }
  EXPECT_EQ(makeShape("paraboloid", Parameters().floats("zmax", {0}))->area(0), 0);
  EXPECT_EQ(makeShape("hyperboloid", Parameters().points("p2", {{1, 1, 0}}))->area(0), 0);
  // The default hyperboloid, a line through the origin, is a cone; pbrt-v3 never ends.
  const auto cone = makeShape("hyperboloid", {});
  EXPECT_NEAR(cone->area(0), kPi * std::sqrt(2.f) * std::sqrt(3.f), 1e-4f);
  const auto hit = cone->intersect(0, {{0, 5, 0.5f}, {0, -1, 0}});
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->t, 5 - std::sqrt(0.5f), 1e-5f);
}

TEST(QuadricSurface, BoundsAreTight) {
  const auto turned = makeShape("sphere", {}, Transform::rotate(45, {1, 1, 0}));
  EXPECT_NEAR(turned->bounds(0).max.x, 1, 1e-6f);
  EXPECT_NEAR(turned->bounds(0).min.z, -1, 1e-6f);
  Parameters quarter;
  quarter.floats("phimax", {90});
  const Bounds3 b = makeShape("disk", quarter)->bounds(0);
  EXPECT_NEAR(b.min.x, 0, 1e-6f);
  EXPECT_NEAR(b.min.y, 0, 1e-6f);
  EXPECT_NEAR(b.max.y, 1, 1e-6f);
}

TEST(QuadricSurface, BrokenInputIsRefusedOrEmpty) {
  Build build;
  const auto message = [&](const Parameters& p, const Transform& t) -> std::string {
    try {
      build.make("sphere", p, t);
    } catch (const SceneError& e) {
      return e.what();
    }
    return "";
  };
  EXPECT_NE(message({}, Transform::scale({1, 0, 1})).find("inverted"), std::string::npos);
  glm::mat4 projective(1);
  projective[2][3] = 1;
  EXPECT_NE(message({}, Transform(projective)).find("projective"), std::string::npos);
  EXPECT_NE(message(Parameters().floats("radius", {-1}), {}), "");
  EXPECT_NE(message(Parameters().floats("radius", {NAN}), {}), "");
  for (const Parameters& p :
       {Parameters().floats("radius", {0}), Parameters().floats("phimax", {0}),
        Parameters().floats("zmin", {0.5f}).floats("zmax", {0.5f})}) {
    const auto empty = makeShape("sphere", p);
    EXPECT_EQ(empty->area(0), 0);
    EXPECT_FALSE(empty->sampleArea(0, {0.5f, 0.5f}));
    EXPECT_FALSE(empty->sampleSolidAngle(0, {0, 0, 3}, {0.5f, 0.5f}));
    EXPECT_FALSE(empty->intersect(0, {{0.1f, 0, -3}, {0, 0, 1}}));
    EXPECT_EQ(empty->pdfSolidAngle(0, {0, 0, 3}, {0, 0, 1}, {0, 0, 1}), 0);
  }
  EXPECT_FALSE(makeShape("disk", Parameters().floats("innerradius", {2}))
                   ->intersect(0, {{1.5f, 0, -3}, {0, 0, 1}}));
}

}  // namespace
}  // namespace lampyris::test
