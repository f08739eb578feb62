// SPDX-License-Identifier: Apache-2.0
#include "accelerators/light_bvh_report.h"

#include <gtest/gtest.h>

#include <numbers>

#include "accelerators/light_bvh.h"

namespace lampyris {
namespace {

LightBVHInput pointLight(LightId id, const Vec3& p, float intensity = 1) {
  LightBVHInput l;
  l.id = id;
  l.bounds.box = Bounds3(p);
  l.bounds.cosThetaO = -1;
  l.bounds.intensity = intensity;
  return l;
}

TEST(LightBVHReport, EmptyTree) {
  const LightTreeReport r = reportLightTree(LightBVHAccel());
  EXPECT_EQ(r.nodes, 0u);
  EXPECT_EQ(r.lights, 0u);
  EXPECT_EQ(r.cost, 0);
  EXPECT_TRUE(lightTreeNodes(LightBVHAccel(), 5).empty());
}

TEST(LightBVHReport, FourLightsByHand) {
  // Two pairs far apart: the tree is balanced.
  const std::vector<LightBVHInput> lights = {pointLight(0, {0, 0, 0}), pointLight(1, {1, 0, 0}, 2),
                                             pointLight(2, {100, 0, 0}),
                                             pointLight(3, {101, 0, 0})};
  const LightBVHAccel tree(lights);
  const LightTreeReport r = reportLightTree(tree);
  EXPECT_EQ(r.lights, 4u);
  EXPECT_EQ(r.nodes, 7u);
  EXPECT_EQ(r.leaves, 4u);
  EXPECT_EQ(r.leastDepth, 2u);
  EXPECT_EQ(r.mostDepth, 2u);
  EXPECT_EQ(r.meanDepth, 2);
  EXPECT_EQ(r.largestLeaf, 1u);
  EXPECT_EQ(r.meanLeaf, 1);
  EXPECT_EQ(r.nodesByDepth, (std::vector<size_t>{1, 2, 4}));
  EXPECT_EQ(r.bytes, tree.stats().bytes);
  // Lines: the area is the squared length, the cones are full. (3·1² + 2·1²) / (5·101²).
  EXPECT_NEAR(r.cost, 1. / (101 * 101), 0.02 / (101 * 101));

  const auto nodes = lightTreeNodes(tree, 1);
  ASSERT_EQ(nodes.size(), 3u);
  EXPECT_EQ(nodes[0].lights, 4u);
  EXPECT_EQ(nodes[0].depth, 0u);
  EXPECT_FALSE(nodes[0].leaf);
  EXPECT_NEAR(nodes[0].box.extent().x, 101, 1);
  EXPECT_NEAR(nodes[0].cost, 5 * sqr(nodes[0].box.extent().x) * 4 * std::numbers::pi, 1e3);
  for (const size_t i : {1, 2}) {
    EXPECT_EQ(nodes[i].depth, 1u);
    EXPECT_EQ(nodes[i].lights, 2u);
  }
  EXPECT_EQ(nodes[1].intensity + nodes[2].intensity, 5);
  EXPECT_EQ(lightTreeNodes(tree, 9).size(), 7u);
}

TEST(LightBVHReport, SomePositions) {
  std::vector<LightBVHInput> lights;
  for (LightId i = 0; i < 10; ++i) lights.push_back(pointLight(i, {static_cast<float>(i), 0, 0}));
  const LightBVHAccel tree(lights);
  EXPECT_EQ(someLightPositions(tree, 100).size(), 10u);
  EXPECT_EQ(someLightPositions(tree, 10).size(), 10u);
  EXPECT_EQ(someLightPositions(tree, 9).size(), 5u);
  EXPECT_EQ(someLightPositions(tree, 1).size(), 1u);
  EXPECT_TRUE(someLightPositions(LightBVHAccel(), 5).empty());
}

TEST(LightBVHReport, NarrowConesCostLess) {
  std::vector<LightBVHInput> lights = {pointLight(0, {0, 0, 0}), pointLight(1, {1, 0, 0})};
  const double wide = lightTreeNodes(LightBVHAccel(lights), 0)[0].cost;
  for (LightBVHInput& l : lights) l.bounds.cosThetaO = 1, l.bounds.cosThetaE = 0;
  const double narrow = lightTreeNodes(LightBVHAccel(lights), 0)[0].cost;
  // Equal normals, θe = π/2: π/2 (1 − cos π) = π, against 4π.
  EXPECT_NEAR(narrow / wide, 0.25, 0.01);
}

}  // namespace
}  // namespace lampyris
