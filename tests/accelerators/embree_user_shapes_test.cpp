// SPDX-License-Identifier: Apache-2.0
#include "accelerators/embree_user_shapes.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "shapes/shape_helpers.h"

namespace lampyris::test {
namespace {

struct Spheres {
  std::vector<std::unique_ptr<Shape>> shapes;
  std::vector<Primitive> primitives;

  void add(const Vec3& centre) {
    shapes.push_back(
        makeShape("sphere", Parameters().floats("radius", {.01f}), Transform::translate(centre)));
    primitives.emplace_back().shape = shapes.back().get();
  }
};

TEST(EmbreeUserShapes, EachComesOnceWhateverTheirOrderInSpace) {
  Spheres scene;
  for (uint64_t i = 0; i < 500; ++i)
    scene.add({uniform(1, i, 0), uniform(1, i, 1), i % 2 == 0 ? 0.f : uniform(1, i, 2)});
  const embree::UserShapes shapes(scene.primitives);
  ASSERT_EQ(shapes.size(), 500u);
  std::set<uint32_t> seen;
  for (uint32_t i = 0; i < shapes.size(); ++i) seen.insert(shapes[i].primitive);
  EXPECT_EQ(seen.size(), 500u);
}

TEST(EmbreeUserShapes, NeighboursInSpaceAreNeighboursInMemory) {
  // A grid of 16³ that is added in the order of a hash.
  Spheres scene;
  std::vector<uint32_t> order(4096);
  for (uint32_t i = 0; i < order.size(); ++i) order[i] = i;
  std::sort(order.begin(), order.end(),
            [](uint32_t a, uint32_t b) { return uniform(2, a, 0) < uniform(2, b, 0); });
  const auto place = [](uint32_t i) {
    const uint32_t y = i / 16 % 16, z = i / 256;
    return Vec3(static_cast<float>(i % 16), static_cast<float>(y), static_cast<float>(z));
  };
  for (const uint32_t i : order) scene.add(place(i));
  const embree::UserShapes shapes(scene.primitives);
  double jumps = 0;
  for (uint32_t i = 1; i < shapes.size(); ++i)
    jumps += static_cast<double>(
        distance(place(order[shapes[i].primitive]), place(order[shapes[i - 1].primitive])));
  // 1.6 along a Z-order curve, 10 in the order of the scene.
  EXPECT_LT(jumps / shapes.size(), 2);
}

TEST(EmbreeUserShapes, PlacesWithoutExtentOrFarAwayAreSorted) {
  Spheres scene;
  for (int i = 0; i < 3; ++i) scene.add(Vec3(1e12f));
  EXPECT_EQ(embree::UserShapes(scene.primitives).size(), 3u);
  scene.add(Vec3(-1e12f));
  scene.add(Vec3(-3e38f));
  scene.add(Vec3(3e38f));
  EXPECT_EQ(embree::UserShapes(scene.primitives).size(), 6u);
  EXPECT_TRUE(embree::UserShapes({}).empty());
}

}  // namespace
}  // namespace lampyris::test
