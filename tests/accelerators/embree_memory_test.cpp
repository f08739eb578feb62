// SPDX-License-Identifier: Apache-2.0
// What Embree is estimated to take, against how far the resident memory rises while it builds.
#include "accelerators/embree_memory.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <malloc.h>

#include <fstream>
#include <iostream>

#include "accelerators/embree_geometry.h"
#include "core/memory.h"
#include "shapes/shape_helpers.h"

// The sanitizers' own memory counts as well.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

namespace lampyris::test {
namespace {

Vec3 place(uint64_t i) { return {uniform(8, i, 0), uniform(8, i, 1), uniform(8, i, 2)}; }

/// Shapes, and what is built of them.
struct Scene {
  std::vector<std::unique_ptr<Shape>> shapes;
  GeometryDescription description;

  Primitive primitive(const std::string& name, const Parameters& parameters,
                      const Transform& t = {}) {
    Primitive p;
    p.shape = shapes.emplace_back(makeShape(name, parameters, t)).get();
    return p;
  }
  void add(const std::string& name, const Parameters& parameters, const Transform& t = {}) {
    description.primitives.push_back(primitive(name, parameters, t));
  }
  void addObject(std::vector<Primitive> primitives) {
    description.objects.push_back({std::move(primitives)});
  }
  void addInstance(uint32_t object, uint64_t i, bool moves = false) {
    ObjectInstance& instance = description.instances.emplace_back();
    instance.object = object;
    instance.instanceToWorld = Transform::translate(place(i));
    if (moves) instance.motion.emplace_back(Transform(), 0.f, Transform::translate(place(i)), 1.f);
  }

  void expectNear(const char* name) {
    const double estimate = estimateEmbreeMemory(description);
    constexpr double kLeast = 0.6, kMost = 1.8;
    // How much is in use at a time while Embree builds varies, by a factor of two for a soup: the
    // estimate is for the largest.
    double factor = kInfinity;
    for (int i = 0; i < 3 && !(factor < kMost); ++i) {
      GeometryDescription copy = description;  // is not to count
      malloc_trim(0);
      std::ofstream reset("/proc/self/clear_refs");
      reset << 5 << std::flush;  // the peak begins anew
      const double before = usedMemory();
      if (!reset || peakMemory() > 1.1 * before) GTEST_SKIP() << "the peak cannot be measured";
      const auto geometry = makeEmbreeGeometry(std::move(copy));
      const double taken = peakMemory() - before;
      factor = estimate / taken;
      std::cout << fmt::format("{}: {:.1f} MB estimated, {:.1f} MB taken, factor {:.2f}\n", name,
                               estimate / 1e6, taken / 1e6, factor);
    }
    EXPECT_GT(factor, kLeast) << name;
    EXPECT_LT(factor, kMost) << name;
  }
};

/// n² cells of two triangles.
Parameters grid(int n) {
  std::vector<Vec3> points;
  std::vector<int32_t> indices;
  for (int y = 0; y <= n; ++y)
    for (int x = 0; x <= n; ++x) {
      points.emplace_back(x, y, uniform(9, points.size(), 0));
      if (x == n || y == n) continue;
      const int a = y * (n + 1) + x, b = a + n + 1;
      indices.insert(indices.end(), {a, a + 1, b + 1, a, b + 1, b});
    }
  return Parameters().points("P", points).integers("indices", indices);
}
/// They share no vertex, and overlap.
Parameters soup(int triangles) {
  std::vector<Vec3> points;
  std::vector<int32_t> indices;
  for (int i = 0; i < 3 * triangles; ++i) {
    points.push_back(place(points.size()));
    indices.push_back(i);
  }
  return Parameters().points("P", points).integers("indices", indices);
}
Parameters curve(uint64_t i) {
  const Vec3 p = place(i);
  return Parameters()
      .points("P", {p, p + 0.1f * place(i + 1), p + 0.1f * place(i + 2), p + Vec3(0.1f)})
      .floats("width", {0.01f});
}
Parameters ball() { return Parameters().floats("radius", {0.01f}); }

TEST(EmbreeMemory, Triangles) {
  makeEmbreeGeometry({});  // starts Embree
  Scene mesh, loose, small;
  mesh.add("trianglemesh", grid(400));
  mesh.expectNear("a mesh");
  loose.add("trianglemesh", soup(200'000));
  loose.expectNear("triangles that overlap");
  for (int i = 0; i < 20'000; ++i) small.add("trianglemesh", grid(1));
  small.expectNear("meshes of two triangles");
}

TEST(EmbreeMemory, OtherShapes) {
  Scene balls, curves;
  for (uint64_t i = 0; i < 100'000; ++i)
    balls.add("sphere", ball(), Transform::translate(place(i)));
  balls.expectNear("spheres");
  for (uint64_t i = 0; i < 40'000; ++i) curves.add("curve", curve(i));
  curves.expectNear("curves");
}

TEST(EmbreeMemory, Instances) {
  Scene many, objects, moving;
  many.addObject({many.primitive("sphere", ball())});
  for (uint64_t i = 0; i < 100'000; ++i) many.addInstance(0, i);
  many.expectNear("instances");
  for (uint32_t i = 0; i < 8000; ++i) {
    objects.addObject({objects.primitive("trianglemesh", grid(4))});
    objects.addInstance(i, i);
    moving.addObject({moving.primitive("sphere", ball())});
    moving.addInstance(i, i, true);
  }
  objects.expectNear("objects of 32 triangles");
  moving.expectNear("spheres that move");
}

}  // namespace
}  // namespace lampyris::test

#endif
