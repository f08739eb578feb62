// SPDX-License-Identifier: Apache-2.0
#include "accelerators/embree_geometry.h"

#include <gtest/gtest.h>

#include "shapes/shape_helpers.h"

namespace lampyris::test {
namespace {

/// 0 where u + v has an even integral part in units of 1/4, else 1.
class Checker final : public FloatTexture {
 public:
  float evaluate(const SurfaceInteraction& at) const override { return opaque(at.uv) ? 1.f : 0.f; }
  static bool opaque(const Vec2& uv) { return static_cast<int>(std::floor(4 * (uv.x + uv.y))) & 1; }
};

Parameters bumpyMesh(int size) {
  std::vector<Vec3> p;
  std::vector<int32_t> indices;
  for (int y = 0; y <= size; ++y)
    for (int x = 0; x <= size; ++x)
      p.push_back({static_cast<float>(x), static_cast<float>(y),
                   2 * uniform(5, static_cast<uint64_t>(y * (size + 1) + x), 0)});
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const int i = y * (size + 1) + x;
      indices.insert(indices.end(), {i, i + 1, i + size + 2, i, i + size + 2, i + size + 1});
    }
  }
  return Parameters().integers("indices", indices).points("P", p);
}

Primitive of(const std::unique_ptr<Shape>& shape) {
  Primitive p;
  p.shape = shape.get();
  return p;
}

Ray randomRay(const Bounds3& box, uint64_t seed, uint64_t i) {
  Ray ray{randomPoint(box, seed, i, 0) + box.diagonal() * randomDirection(seed, i, 3), Vec3(0)};
  ray.d = (0.1f + 5 * uniform(seed, i, 9)) * (randomPoint(box, seed, i, 6) - ray.o);
  ray.time = 0.25f;
  return ray;
}

struct Mixed {
  Transform map;
  std::vector<std::unique_ptr<Shape>> shapes;
  explicit Mixed(const Transform& t) : map(t) {
    shapes.push_back(makeShape("trianglemesh", bumpyMesh(6), t));
    shapes.push_back(makeShape("sphere", Parameters().floats("zmax", {0.5f}),
                               t * Transform::translate({3, 3, 3}) * Transform::scale({1, 2, 1})));
    shapes.push_back(makeShape("disk", {}, t * Transform::translate({1, 4, 3})));
    shapes.push_back(makeShape("cylinder", {}, t * Transform::translate({5, 1, 2})));
  }
  std::vector<Primitive> primitives() const {
    std::vector<Primitive> out;
    for (const auto& s : shapes) out.push_back(of(s));
    return out;
  }
  Bounds3 bounds() const {
    Bounds3 b;
    for (const auto& s : shapes) b.extend(totalBounds(*s));
    return b;
  }
};

TEST(EmbreeGeometry, AgreesWithBruteForce) {
  const Mixed mixed{Transform()};
  const auto geometry = makeEmbreeGeometry({mixed.primitives(), {}, {}});
  int hits = 0, disagreements = 0;
  for (uint64_t i = 0; i < 4000; ++i) {
    Ray ray = randomRay(mixed.bounds(), 1, i);
    float nearest = kInfinity;
    uint32_t primitive = 0, element = 0;
    for (uint32_t s = 0; s < mixed.shapes.size(); ++s) {
      const auto hit = bruteForce(*mixed.shapes[s], ray);
      if (hit && hit->hit.t < nearest) nearest = hit->hit.t, primitive = s, element = hit->element;
    }
    const auto hit = geometry->intersect(ray);
    EXPECT_EQ(geometry->occluded(ray), hit.has_value());
    // Edges may be decided otherwise by single precision.
    if (hit.has_value() != std::isfinite(nearest)) {
      ++disagreements;
      continue;
    }
    if (!hit) continue;
    ++hits;
    EXPECT_NEAR(hit->shape.t, nearest, 1e-4f * nearest);
    EXPECT_EQ(hit->primitive, primitive);
    if (hit->element != element) ++disagreements;
    const SurfaceInteraction at = geometry->surface(ray, *hit, SurfaceDetail::Basic);
    EXPECT_LT(distance(at.p, ray.at(hit->shape.t)), 1e-5f * (20 + length(ray.o)));
    EXPECT_LT(distance(at.wo, -normalize(ray.d)), 1e-6f);
    EXPECT_EQ(at.time, 0.25f);
    EXPECT_EQ(at.primitive, &geometry->primitive(*hit));
    EXPECT_EQ(at.element, hit->element);
    ray.tMax = hit->shape.t;
    EXPECT_FALSE(geometry->intersect(ray) && geometry->intersect(ray)->shape.t >= ray.tMax);
    ray.tMax = hit->shape.t * 0.999f;
    EXPECT_FALSE(geometry->occluded(ray));
    ray.tMax = hit->shape.t * 1.001f;
    EXPECT_TRUE(geometry->occluded(ray));
  }
  EXPECT_GT(hits, 1000);
  EXPECT_LE(disagreements, 4);
  const Bounds3 want = mixed.bounds(), got = geometry->bounds();
  EXPECT_LT(distance(want.min, got.min) + distance(want.max, got.max), 1e-4f);
}

/// Spheres of all sizes, whole and cut, some turned and stretched, near the origin and far away.
struct Spheres {
  std::vector<std::unique_ptr<Shape>> shapes;
  std::vector<Primitive> primitives;
  Spheres(float scale, const Vec3& origin) {
    for (uint64_t i = 0; i < 60; ++i) {
      const float radius = std::pow(10.f, -4 * uniform(7, i, 0)) * 0.3f;
      const Vec3 center(uniform(7, i, 1), uniform(7, i, 2), uniform(7, i, 3));
      Transform map = Transform::translate(origin) * Transform::scale(Vec3(scale)) *
                      Transform::translate(center) * Transform::rotate(40, {1, 2, 3});
      if (i % 5 == 0) map = map * Transform::scale({1, 0.5f, 2});
      Parameters p = Parameters().floats("radius", {radius});
      if (i % 3 == 0) p.floats("zmax", {0.5f * radius});
      shapes.push_back(makeShape("sphere", p, map));
    }
    for (const auto& s : shapes) primitives.push_back(of(s));
  }
};

TEST(EmbreeGeometry, PassesNoSphereByThatARayMeets) {
  for (const float scale : {1.f, 1e-6f, 1e6f}) {
    for (const float away : {0.f, 1e3f}) {
      const Spheres spheres(scale, Vec3(scale * away));
      const auto geometry = makeEmbreeGeometry({spheres.primitives, {}, {}});
      int hits = 0;
      for (uint64_t i = 0; i < 6000; ++i) {
        // At the rim of a sphere, just in or out.
        const Bounds3 box = spheres.shapes[i % 60]->bounds(0);
        const Vec3 w = randomDirection(11, i, 0), side = randomDirection(11, i, 3);
        const Vec3 rim = normalize(side - dot(side, w) * w) * (0.5f * (box.max - box.min).x);
        const float length = scale * (0.1f + uniform(11, i, 6));
        const Vec3 target = box.centroid() + rim * (0.99f + 0.011f * uniform(11, i, 7));
        Ray ray{target - length * w, length * w};
        if (i % 4 == 0) ray.tMax = 1;
        float nearest = kInfinity;
        for (const auto& s : spheres.shapes)
          if (const auto hit = s->intersect(0, ray)) nearest = std::min(nearest, hit->t);
        const auto hit = geometry->intersect(ray);
        ASSERT_EQ(hit.has_value(), std::isfinite(nearest)) << scale << " " << away << " " << i;
        ASSERT_EQ(geometry->occluded(ray), hit.has_value());
        if (hit) {
          ASSERT_EQ(hit->shape.t, nearest);
        }
        hits += hit.has_value();
      }
      EXPECT_GT(hits, 2000);
    }
  }
}

TEST(EmbreeGeometry, VeryManySpheresAreMetLikeFew) {
  const auto mesh = makeShape("trianglemesh", bumpyMesh(6), Transform());
  std::vector<std::unique_ptr<Shape>> shapes;
  std::vector<Primitive> spheres;
  for (uint64_t i = 0; i < 20000; ++i) {
    const Vec3 center(6 * uniform(8, i, 0), 6 * uniform(8, i, 1), 2 + 4 * uniform(8, i, 2));
    shapes.push_back(
        makeShape("sphere", Parameters().floats("radius", {0.03f}), Transform::translate(center)));
    spheres.push_back(of(shapes.back()));
  }
  std::vector<Primitive> all = spheres;
  all.push_back(of(mesh));
  const auto direct = makeEmbreeGeometry({all, {}, {}});
  const auto instanced =
      makeEmbreeGeometry({{of(mesh)}, {{spheres}}, {{0, Transform::translate({0, 0, 0})}}});
  int hits = 0;
  for (uint64_t i = 0; i < 150; ++i) {
    const Ray ray = randomRay(totalBounds(*mesh), 9, i);
    float nearest = kInfinity;
    for (const Primitive& p : all)
      if (const auto hit = bruteForce(*p.shape, ray)) nearest = std::min(nearest, hit->hit.t);
    for (const Geometry* g : {direct.get(), instanced.get()}) {
      const auto hit = g->intersect(ray);
      EXPECT_EQ(hit.has_value(), std::isfinite(nearest));
      EXPECT_EQ(g->occluded(ray), std::isfinite(nearest));
      if (hit) {
        EXPECT_NEAR(hit->shape.t, nearest, 1e-4f * nearest);
      }
    }
    hits += std::isfinite(nearest);
  }
  EXPECT_GT(hits, 100);
}

TEST(EmbreeGeometry, EmptyAndTinyScenes) {
  const auto none = makeEmbreeGeometry({});
  EXPECT_FALSE(none->intersect({{0, 0, 0}, {0, 0, 1}}));
  EXPECT_FALSE(none->occluded({{0, 0, 0}, {0, 0, 1}}));
  EXPECT_TRUE(none->bounds().empty());
  const auto nothing = makeShape("sphere", Parameters().floats("radius", {0}));
  EXPECT_FALSE(makeEmbreeGeometry({{of(nothing)}, {}, {}})->occluded({{0, 0, -5}, {0, 0, 1}}));
  const auto sphere = makeShape("sphere", {});
  const auto one = makeEmbreeGeometry({{of(sphere)}, {}, {}});
  const Ray ray{{0, 0, -5}, {0, 0, 2}};
  ASSERT_TRUE(one->intersect(ray));
  EXPECT_NEAR(one->intersect(ray)->shape.t, 2, 1e-6f);
  EXPECT_FALSE(one->intersect({{0, 0, -5}, {0, 0, 2}, 2.f}));
  EXPECT_FALSE(one->intersect({{0, 0, -5}, {0, 0, 2}, 0.f}));
  EXPECT_FALSE(one->intersect({{0, 0, -5}, {0, 0, 2}, -1.f}));
  EXPECT_FALSE(one->occluded({{0, 0, -5}, {0, 0, 2}, 1.99f}));
  // What Embree could not stand.
  EXPECT_FALSE(one->intersect({Vec3(NAN), {0, 0, 1}}));
  EXPECT_FALSE(one->occluded({Vec3(0), {0, NAN, 1}}));
  EXPECT_FALSE(one->occluded({Vec3(0), {0, kInfinity, 1}}));
  EXPECT_FALSE(one->intersect({Vec3(1e30f), {0, 0, 1}}));
  EXPECT_FALSE(one->intersect({Vec3(0, 0, -5), {0, 0, 1}, NAN}));
  one->occluded({Vec3(0.5f), Vec3(0)});
  const auto tiny =
      makeEmbreeGeometry({{of(sphere)}, {{{of(sphere)}}}, {{0, Transform::scale(Vec3(1e-15f))}}});
  EXPECT_TRUE(tiny->intersect(ray));
}

TEST(EmbreeGeometry, InstancesEqualTransformedCopies) {
  const Mixed definition{Transform()};
  const std::vector<Transform> maps = {
      Transform::translate({20, 0, 0}) * Transform::rotate(50, {1, 1, 0}),
      Transform::translate({0, 25, 3}) * Transform::scale({-1, 1, 1}),
      Transform::translate({0, 0, -30}) * Transform::scale({1, 0.4f, 2}) *
          Transform::rotate(20, {0, 0, 1}),
      Transform::scale({1, 0, 1})};
  GeometryDescription description{{}, {{definition.primitives()}, {{}}}, {}};
  for (const Transform& m : maps) description.instances.push_back({0, m});
  description.instances.push_back({1, Transform()});
  const auto instanced = makeEmbreeGeometry(description);
  std::vector<Mixed> copies;
  std::vector<Primitive> flat;
  for (size_t i = 0; i < 3; ++i) copies.emplace_back(maps[i]);
  for (const Mixed& m : copies)
    for (const Primitive& p : m.primitives()) flat.push_back(p);
  const auto direct = makeEmbreeGeometry({flat, {}, {}});
  int hits = 0, disagreements = 0;
  for (uint64_t i = 0; i < 9000; ++i) {
    const Ray ray = randomRay(copies[i % 3].bounds(), 2, i);
    const auto a = instanced->intersect(ray), b = direct->intersect(ray);
    EXPECT_EQ(instanced->occluded(ray), a.has_value());
    if (a.has_value() != b.has_value() || (a && a->element != b->element)) {
      ++disagreements;
      continue;
    }
    if (!a) continue;
    ++hits;
    EXPECT_EQ(a->instance * 4 + a->primitive, b->primitive);
    EXPECT_NEAR(a->shape.t, b->shape.t, 1e-4f * b->shape.t);
    const SurfaceInteraction s = instanced->surface(ray, *a, SurfaceDetail::Full);
    const SurfaceInteraction t = direct->surface(ray, *b, SurfaceDetail::Full);
    EXPECT_EQ(s.primitive->shape, definition.shapes[a->primitive].get());
    EXPECT_LT(distance(s.p, t.p), 1e-4f);
    // A mirror turns the normal with the instance's space, but keeps a copy's side.
    EXPECT_GT(std::abs(dot(s.n, t.n)), 0.999f);
    EXPECT_GT(std::abs(dot(s.shading.n, t.shading.n)), 0.999f);
    EXPECT_GT(dot(s.n, s.shading.n), 0);
    EXPECT_LT(distance(s.dpdu, t.dpdu), 1e-2f * (1 + length(t.dpdu)));
    EXPECT_LT(distance(s.dpdv, t.dpdv), 1e-2f * (1 + length(t.dpdv)));
    const float sign = dot(s.n, t.n) < 0 ? -1.f : 1.f;
    EXPECT_LT(distance(s.dndu, sign * t.dndu), 2e-2f * (1 + length(t.dndu)));
    EXPECT_LT(distance(s.dndv, sign * t.dndv), 2e-2f * (1 + length(t.dndv)));
  }
  EXPECT_GT(hits, 2000);
  EXPECT_LE(disagreements, 20);
}

TEST(EmbreeGeometry, AlphaLetsRaysPass) {
  const Parameters square = Parameters()
                                .integers("indices", {0, 1, 2, 0, 2, 3})
                                .points("P", {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}})
                                .floats("uv", {0, 0, 1, 0, 1, 1, 0, 1});
  const auto front = makeShape("trianglemesh", square, Transform::translate({0, 0, -1}));
  const auto back = makeShape("trianglemesh", square);
  const Checker checker;
  for (const bool shadowOnly : {false, true}) {
    Primitive cut = of(front);
    (shadowOnly ? cut.shadowAlpha : cut.alpha) = &checker;
    for (const bool instanced : {false, true}) {
      GeometryDescription d;
      if (instanced) {
        d.objects = {{{cut, of(back)}}};
        d.instances = {{0, Transform()}};
      } else {
        d.primitives = {cut, of(back)};
      }
      const auto geometry = makeEmbreeGeometry(d);
      for (uint64_t i = 0; i < 500; ++i) {
        const Vec2 uv(0.98f * uniform(3, i, 0) + 0.01f, 0.98f * uniform(3, i, 1) + 0.01f);
        if (std::abs(4 * (uv.x + uv.y) - std::round(4 * (uv.x + uv.y))) < 1e-3f) continue;
        const Ray ray{{uv.x, uv.y, -3}, {0, 0, 1}};
        const auto hit = geometry->intersect(ray);
        ASSERT_TRUE(hit);
        EXPECT_EQ(hit->primitive, shadowOnly || Checker::opaque(uv) ? 0u : 1u);
        EXPECT_EQ(geometry->occluded({ray.o, ray.d, 2.5f}), Checker::opaque(uv));
        EXPECT_TRUE(geometry->occluded(ray));
      }
    }
  }
}

TEST(EmbreeGeometry, AlphaOfCurvedShapesShowsTheirFarSide) {
  const auto sphere = makeShape("sphere", {});
  const Checker checker;
  Primitive cut = of(sphere);
  cut.alpha = &checker;
  const auto geometry = makeEmbreeGeometry({{cut}, {}, {}});
  for (uint64_t i = 0; i < 500; ++i) {
    Ray ray{3.f * randomDirection(4, i, 0), Vec3(0)};
    ray.d = 0.9f * randomDirection(4, i, 2) * uniform(4, i, 4) - ray.o;
    const auto first = sphere->intersect(0, ray);
    ASSERT_TRUE(first);
    const Vec3 p = ray.at(first->t);
    const auto second = sphere->intersect(0, {p + 1e-3f * ray.d, ray.d});
    ASSERT_TRUE(second);
    const auto hit = geometry->intersect(ray);
    const float far = first->t + 1e-3f + second->t;
    const bool near = Checker::opaque(first->uv), opposite = Checker::opaque(second->uv);
    ASSERT_EQ(hit.has_value(), near || opposite);
    EXPECT_EQ(geometry->occluded(ray), near || opposite);
    if (hit) {
      EXPECT_NEAR(hit->shape.t, near ? first->t : far, 1e-4f);
    }
  }
}

TEST(EmbreeGeometry, WatertightAlongEdges) {
  const auto mesh = makeShape("trianglemesh", bumpyMesh(8));
  const auto geometry = makeEmbreeGeometry({{of(mesh)}, {}, {}});
  const TriangleBuffers t = mesh->triangles();
  for (uint64_t i = 0; i < 20000; ++i) {
    // Aim at points of interior edges and at vertices, from above.
    const auto k = static_cast<size_t>(uniform(6, i, 0) * static_cast<float>(t.triangleCount));
    const Vec3 a = t.positions[t.indices[3 * k]], b = t.positions[t.indices[3 * k + 2]];
    const Vec3 p = a + (i % 4 == 0 ? 0 : uniform(6, i, 1)) * (b - a);
    if (p.x <= 0 || p.y <= 0 || p.x >= 8 || p.y >= 8) continue;
    const Vec3 o(8 * uniform(6, i, 2), 8 * uniform(6, i, 3), 40);
    ASSERT_TRUE(geometry->intersect({o, p - o})) << i;
  }
}

TEST(EmbreeGeometry, RaysThatLeaveAFlatMeshDoNotMeetItAgain) {
  for (const float scale : {1e-4f, 1.f, 1e4f}) {
    for (const float far : {0.f, 1e5f}) {
      for (const bool instanced : {false, true}) {
        SCOPED_TRACE(std::to_string(scale) + " " + std::to_string(far) +
                     (instanced ? " instanced" : ""));
        // In an instance the definition is at the origin and the map carries the distance.
        const Transform place = Transform::translate(far * scale * Vec3(1, -0.4f, 0.7f)) *
                                Transform::scale(Vec3(scale)) * Transform::rotate(33, {1, 2, 3});
        const Transform inside = instanced ? Transform() : place;
        std::vector<std::unique_ptr<Shape>> shapes;
        shapes.push_back(makeShape("trianglemesh",
                                   Parameters()
                                       .integers("indices", {0, 1, 2})
                                       .points("P", {{-3, -2, 0}, {2, -1, 0.3f}, {0.5f, 4, 1}}),
                                   inside));
        shapes.push_back(makeShape("sphere", {}, inside * Transform::translate({20, 0, 0})));
        GeometryDescription d;
        for (const auto& s : shapes) d.primitives.push_back(of(s));
        if (instanced) {
          d.objects = {{d.primitives}};
          d.primitives.clear();
          d.instances = {{0, place}};
        }
        const auto geometry = makeEmbreeGeometry(d);
        for (uint64_t i = 0; i < 2000; ++i) {
          const auto s = shapes[i % 2]->sampleArea(0, {uniform(7, i, 0), uniform(7, i, 1)});
          const Vec3 target = instanced ? place.point(s->p) : s->p;
          const Vec3 n = instanced ? normalize(place.normal(s->n)) : s->n;
          const Ray ray{target + 3 * scale * faceForward(randomDirection(7, i, 2), n), Vec3(0)};
          const Ray aimed{ray.o, target - ray.o};
          const auto hit = geometry->intersect(aimed);
          if (!hit || hit->primitive != i % 2) continue;
          const SurfaceInteraction at = geometry->surface(aimed, *hit, SurfaceDetail::Basic);
          const Vec3 w = faceForward(randomDirection(7, i, 4), faceForward(at.n, at.wo));
          if (std::abs(dot(w, at.n)) < 1e-3f) continue;
          const auto again = geometry->intersect({offsetRayOrigin(at.p, at.pError, at.n, w), w});
          EXPECT_FALSE(again && again->primitive == hit->primitive) << i;
        }
      }
    }
  }
}

}  // namespace
}  // namespace lampyris::test
