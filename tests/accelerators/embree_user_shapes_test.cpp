// SPDX-License-Identifier: Apache-2.0
#include "accelerators/embree_user_shapes.h"

#include <gtest/gtest.h>

#include <algorithm>

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

std::vector<uint32_t> primitivesInOrder(const embree::UserShapes& shapes) {
  std::vector<uint32_t> found;
  for (uint32_t i = 0; i < shapes.size(); ++i)
    shapes.forEach(i, [&](const embree::UserShapes::Element& e) { found.push_back(e.primitive); });
  return found;
}

TEST(EmbreeUserShapes, EachComesOnceWhateverTheirOrderInSpace) {
  Spheres scene;
  for (uint64_t i = 0; i < 500; ++i)
    scene.add({uniform(1, i, 0), uniform(1, i, 1), i % 2 == 0 ? 0.f : uniform(1, i, 2)});
  std::vector<uint32_t> found = primitivesInOrder(embree::UserShapes(scene.primitives));
  ASSERT_EQ(found.size(), 500u);
  std::sort(found.begin(), found.end());
  for (uint32_t i = 0; i < found.size(); ++i) EXPECT_EQ(found[i], i);
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
  const std::vector<uint32_t> found = primitivesInOrder(embree::UserShapes(scene.primitives));
  ASSERT_EQ(found.size(), 4096u);
  double jumps = 0;
  for (size_t i = 1; i < found.size(); ++i)
    jumps += static_cast<double>(distance(place(order[found[i]]), place(order[found[i - 1]])));
  // 1.6 along a Z-order curve, 10 in the order of the scene.
  EXPECT_LT(jumps / 4096, 2);
}

TEST(EmbreeUserShapes, PlacesWithoutExtentOrFarAwayComeOnceToo) {
  Spheres scene;
  for (int i = 0; i < 30; ++i) scene.add(Vec3(1e12f));
  EXPECT_EQ(primitivesInOrder(embree::UserShapes(scene.primitives)).size(), 30u);
  scene.add(Vec3(-1e12f));
  scene.add(Vec3(-3e38f));
  scene.add(Vec3(3e38f));
  EXPECT_EQ(primitivesInOrder(embree::UserShapes(scene.primitives)).size(), 33u);
  EXPECT_EQ(embree::UserShapes({}).size(), 0u);
}

TEST(EmbreeUserShapes, OnlyCloseSpheresShareAGroup) {
  Spheres close, apart;
  for (uint64_t i = 0; i < 800; ++i) {
    const Vec3 place(uniform(3, i, 0), uniform(3, i, 1), uniform(3, i, 2));
    close.add(place * .1f);
    apart.add(place * 10.f);
  }
  EXPECT_LT(embree::UserShapes(close.primitives).size(), 200u);
  EXPECT_GT(embree::UserShapes(apart.primitives).size(), 700u);
}

TEST(EmbreeUserShapes, ShapesWithoutABallStandAlone) {
  Spheres scene;
  for (int i = 0; i < 4; ++i) scene.add(Vec3(0.f));
  const auto disk = makeShape("disk", Parameters(), Transform());
  for (int i = 0; i < 3; ++i) scene.primitives.emplace_back().shape = disk.get();
  const embree::UserShapes shapes(scene.primitives);
  EXPECT_EQ(shapes.size(), 4u);
  EXPECT_EQ(primitivesInOrder(shapes).size(), 7u);
  // A ray that meets neither: only spheres are told from afar.
  RTCRay ray{};
  ray.org_x = 5, ray.dir_z = 1, ray.tfar = kInfinity;
  std::vector<uint32_t> met;
  for (uint32_t i = 0; i < shapes.size(); ++i)
    shapes.forEachMet(i, ray,
                      [&](const embree::UserShapes::Element& e) { met.push_back(e.primitive); });
  EXPECT_EQ(met, (std::vector<uint32_t>{4, 5, 6}));
}

}  // namespace
}  // namespace lampyris::test
