// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "accelerators/embree_geometry.h"
#include "shapes/shape_helpers.h"

namespace lampyris::test {
namespace {

struct Moving {
  std::unique_ptr<Shape> mesh, ball;
  std::vector<AnimatedTransform> motion;

  explicit Moving(std::vector<AnimatedTransform> m) : motion(std::move(m)) {
    mesh = makeShape("trianglemesh",
                     Parameters()
                         .integers("indices", {0, 1, 2, 0, 2, 3})
                         .points("P", {{-1, -1, 0}, {1, -1, 0}, {1, 1, 1}, {-1, 1, 0}}));
    ball =
        makeShape("sphere", Parameters().floats("radius", {0.5f}), Transform::translate({0, 0, 1}));
  }
  std::vector<Primitive> primitives() const {
    std::vector<Primitive> out(2);
    out[0].shape = mesh.get();
    out[1].shape = ball.get();
    return out;
  }
  std::unique_ptr<Geometry> geometry() const {
    ObjectInstance instance;
    instance.motion = motion;
    return makeEmbreeGeometry({{}, {{primitives()}}, {instance}});
  }
  /// What stands there at a time.
  std::unique_ptr<Geometry> frozen(float time) const {
    ObjectInstance instance;
    instance.motion = motion;
    ObjectInstance still;
    still.instanceToWorld = instance.toWorld(time);
    return makeEmbreeGeometry({{}, {{primitives()}}, {still}});
  }
};

Moving tumbling() {
  const Transform a = Transform::translate({-2, 1, 0}) * Transform::rotate(20, {1, 0, 1});
  const Transform b = Transform::translate({3, 0, 2}) * Transform::rotate(140, {0, 1, 1}) *
                      Transform::scale({2, 1, -1});
  const Transform inner = Transform::rotate(90, {0, 0, 1}) * Transform::scale(Vec3(0.5f));
  return Moving({AnimatedTransform(a, 0.2f, b, 0.9f), AnimatedTransform({}, 0, inner, 1)});
}

TEST(EmbreeMotion, RaysMeetWhatIsThereAtTheirTime) {
  const Moving moving = tumbling();
  const auto geometry = moving.geometry();
  const Bounds3 box = geometry->bounds();
  int hits = 0;
  // Between the keys the map mirrors from one time on; before, it is flat for a moment.
  for (const float time : {0.f, 0.3f, 0.45f, 0.8f, 1.f}) {
    const auto frozen = moving.frozen(time);
    EXPECT_TRUE(box.contains(frozen->bounds().min + Vec3(1e-4f)) &&
                box.contains(frozen->bounds().max - Vec3(1e-4f)));
    for (uint64_t i = 0; i < 1000; ++i) {
      Ray ray{randomPoint(box, 3, i, 0) + box.diagonal() * randomDirection(3, i, 3), Vec3(0)};
      ray.d = 2.f * (randomPoint(frozen->bounds(), 3, i, 6) - ray.o);
      ray.time = time;
      const auto hit = geometry->intersect(ray), expected = frozen->intersect(ray);
      ASSERT_EQ(hit.has_value(), expected.has_value()) << time << " " << i;
      EXPECT_EQ(geometry->occluded(ray), hit.has_value());
      if (!hit) continue;
      ++hits;
      EXPECT_NEAR(hit->shape.t, expected->shape.t, 1e-5f * expected->shape.t);
      EXPECT_EQ(hit->primitive, expected->primitive);
      const SurfaceInteraction s = geometry->surface(ray, *hit, SurfaceDetail::Full);
      const SurfaceInteraction e = frozen->surface(ray, *expected, SurfaceDetail::Full);
      EXPECT_LT(distance(s.p, e.p), 1e-4f);
      EXPECT_LT(distance(s.n, e.n), 1e-3f);
      EXPECT_LT(distance(s.dpdu, e.dpdu), 1e-3f * (1 + length(e.dpdu)));
      EXPECT_EQ(s.time, time);
      EXPECT_LT(distance(s.p, ray.at(hit->shape.t)), 1e-4f * length(ray.d));
      // What is nearer ends the search.
      ray.tMax = 0.999f * hit->shape.t;
      EXPECT_FALSE(geometry->intersect(ray));
    }
  }
  EXPECT_GT(hits, 1000);
}

TEST(EmbreeMotion, StillAndMovingThingsShareAScene) {
  const auto ball = makeShape("sphere", {});
  Primitive p;
  p.shape = ball.get();
  ObjectInstance moving, still;
  moving.motion = {
      AnimatedTransform(Transform::translate({5, 0, 0}), 0, Transform::translate({9, 0, 0}), 1)};
  still.instanceToWorld = Transform::translate({0, 0, -5});
  const auto geometry = makeEmbreeGeometry({{p}, {{{p}}}, {moving, still}});
  const auto at = [&](float x, float time) {
    return geometry->intersect({{x, 0, 10}, {0, 0, -1}, kInfinity, time});
  };
  EXPECT_EQ(at(0, 0.5f)->instance, Hit::kNoInstance);
  EXPECT_EQ(at(7, 0.5f)->instance, 0u);
  EXPECT_FALSE(at(7, 0));
  EXPECT_EQ(at(8.9f, 1)->instance, 0u);
  EXPECT_EQ(geometry->intersect({{0, 0, -3}, {0, 0, -1}})->instance, 1u);
}

TEST(EmbreeMotion, AMomentWithoutExtentIsHarmless) {
  // From a shape to its mirror image: flat half way.
  const Moving moving({AnimatedTransform({}, 0, Transform::scale({1, 1, -1}), 1)});
  const auto geometry = moving.geometry();
  for (const float time : {0.5f, std::nextafter(0.5f, 1.f), std::nextafter(0.5f, 0.f)}) {
    for (uint64_t i = 0; i < 200; ++i) {
      const Vec3 o = 4.f * randomDirection(5, i, 0);
      const Ray ray{o, randomDirection(5, i, 2) - o, kInfinity, time};
      const auto hit = geometry->intersect(ray);
      geometry->occluded(ray);
      if (hit) {
        EXPECT_TRUE(isFinite(geometry->surface(ray, *hit, SurfaceDetail::Basic).p));
      }
    }
  }
}

}  // namespace
}  // namespace lampyris::test
