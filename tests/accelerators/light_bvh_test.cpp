// SPDX-License-Identifier: Apache-2.0
#include "accelerators/light_bvh.h"

#include "light_trees.h"

namespace lampyris::test {
namespace {

void checkStructure(const LightBVHAccel& tree, size_t lights) {
  const auto& nodes = tree.nodes();
  ASSERT_EQ(nodes.size(), 2 * lights - 1);
  size_t leaves = 0;
  for (uint32_t i = 0; i < nodes.size(); ++i) {
    if (nodes[i].isLeaf()) {
      ++leaves;
      EXPECT_EQ(tree.leafOf(nodes[i].light()), i);
      continue;
    }
    const uint32_t right = nodes[i].rightChild();
    ASSERT_GT(right, i + 1);
    ASSERT_LT(right, nodes.size());
    // Cones only widen, and so the intensity of the same flux falls.
    const float sum = nodes[i + 1].intensity() + nodes[right].intensity();
    EXPECT_GT(nodes[i].intensity(), 0);
    EXPECT_LE(nodes[i].intensity(), 1.001f * sum);
    if (nodes[i + 1].allNormals() && nodes[right].allNormals()) {
      EXPECT_NEAR(nodes[i].intensity(), sum, 1e-5f * sum);
    }
  }
  EXPECT_EQ(leaves, lights);
}

TEST(LightBVH, StructureAndDepth) {
  for (const Kind kind : {Kind::Points, Kind::Line, Kind::Coincident, Kind::Cones, Kind::TwoSided})
    for (const size_t count : {size_t{1}, size_t{2}, size_t{3}, size_t{17}, size_t{3000}}) {
      const LightBVHAccel tree(makeLights(kind, count));
      checkStructure(tree, count);
      EXPECT_LE(tree.stats().depth, 4 + 2 * std::log2(static_cast<double>(count)));
      EXPECT_EQ(tree.stats().nodes, tree.nodes().size());
    }
}

TEST(LightBVH, SplitsByOrientation) {
  // Two coincident sheets that face opposite ways along z, a little apart in z, wide in x and y.
  std::vector<LightBVHInput> lights(512);
  for (size_t i = 0; i < lights.size(); ++i) {
    lights[i].id = static_cast<LightId>(i);
    LightBounds& b = lights[i].bounds;
    b.box = Bounds3(Vec3(random(i, 0), random(i, 1), i % 2 ? 0.6f : 0.f));
    b.axis = {0, 0, i % 2 ? 1.f : -1.f};
    b.cosThetaO = 1;
    b.intensity = 1;
  }
  const LightBVHAccel tree(lights);
  EXPECT_LT(tree.nodes()[1].halfSineO(), 0.1f);
}

TEST(LightBVH, ByIntensity) {
  const auto lights = makeLights(Kind::Points, 100);
  const LightBVHAccel tree(lights);
  double total = 0;
  for (const auto& l : lights) total += static_cast<double>(l.bounds.intensity);
  for (const auto& l : lights)
    EXPECT_NEAR(static_cast<double>(tree.pmfByIntensity(0, tree.leafOf(l.id))),
                static_cast<double>(l.bounds.intensity) / total, 1e-6);
  for (int k = 0; k < 100; ++k) {
    const SampledLight s = tree.sampleByIntensity(0, (k + 0.5) / 100);
    EXPECT_EQ(s.pmf, tree.pmfByIntensity(0, tree.leafOf(s.light)));
  }
}

}  // namespace
}  // namespace lampyris::test
