// SPDX-License-Identifier: Apache-2.0
/// Faults of other programs' light trees that concern lights as scenes have them; one test each,
/// named after the fault. Those of the tree itself: accelerators/light_tree_faults_test.cpp; of
/// units of power: lights/light_units_test.cpp.
#include <gtest/gtest.h>

#include "light_scenes.h"
#include "lights/area_registry.h"
#include "shapes/registry.h"
#include "support/statistics.h"

namespace lampyris::test {
namespace {

/// Both forms of the tree, and splitting.
const TestParameters::List kForms[] = {
    {}, {{"tree", "binary"}}, {{"splitthreshold", "0.3"}, {"maxcut", "4"}}};

std::unique_ptr<LightScene> sceneNamed(const std::string& name) {
  for (auto& s : smallLightScenes())
    if (s->name == name) return std::move(s);
  throw std::logic_error("no scene " + name);
}

// pbrt-v4: the point is moved off the surface for sampling and isn't for the pmf.
TEST(BvhFault, SamplingAndPmfSeeDifferentPoints) {
  const auto scene = sceneNamed("two-sided");
  DistributionMaker maker;
  for (const auto& form : kForms) {
    const auto d = maker.make("bvh", *scene, form);
    for (LightSampleContext c : contextsFor(*scene, 24)) {
      LightSampleContext sure = c;
      c.pError = Vec3(0.2f);  // where a move shows
      for (LightId l = 0; l < scene->table.size(); ++l) {
        ASSERT_EQ(d->pmf(c, l), d->pmf(sure, l));
        ASSERT_EQ(d->expectedCount(c, l), d->expectedCount(sure, l));
      }
      for (int i = 0; i < 20; ++i) {
        const auto s = d->sample(c, static_cast<float>(i) / 20);
        if (s) {
          ASSERT_EQ(s->pmf, d->pmf(c, s->light));
        }
      }
    }
  }
}

// The thesis's program: infinite and distant lights lie in the tree with empty bounds.
TEST(BvhFault, LightsWithoutPositionHaveEmptyBounds) {
  const auto scene = sceneNamed("mixed");
  DistributionMaker maker;
  for (const auto& form : kForms) {
    const auto d = maker.make("bvh", *scene, form);
    for (const LightSampleContext& c : contextsFor(*scene, 24)) {
      double beside = 0;
      bool reached = false;
      for (LightId l = 0; l < scene->table.size(); ++l) {
        if (!scene->table[l].light->isInfinite()) continue;
        beside += static_cast<double>(d->pmf(c, l));
        if (contribution(*scene, c, l, {0.3f, 0.6f}) > 0) reached = true;
      }
      if (reached) {
        EXPECT_GE(beside, 0.0999);
      }
    }
  }
  // Projection and goniometric lights have a position, and are in the tree.
  const auto patterns = sceneNamed("patterns");
  for (LightId l = 0; l < patterns->table.size(); ++l) {
    const auto entry = patterns->table[l];
    const auto bounds = entry.light->bounds(entry.element);
    ASSERT_TRUE(bounds && !bounds->box.empty());
    EXPECT_GT(bounds->intensity, 0);
  }
}

// The thesis's program crashes on them; Falcor knows triangles only.
TEST(BvhFault, OnlyTrianglesEmit) {
  LightScene scene;
  TestBuild build;
  for (const char* name : {"sphere", "disk", "cylinder", "cone", "paraboloid", "hyperboloid"}) {
    const auto& plugin = shapeRegistry().get(name, {});
    const TestParameters p(plugin.schema, {});
    const auto x = static_cast<float>(scene.shapes.size()) * 5;
    scene.shapes.push_back(plugin.create(
        p.set(),
        ShapeContext{build.base(), build.textures, Transform::translate({x, 0, 0}), false}));
    scene.bounds.extend(scene.shapes.back()->bounds(0));
  }
  for (const auto& shape : scene.shapes) {
    ImageCache images;
    const auto& plugin = areaLightRegistry().get("diffuse", {});
    const TestParameters p(plugin.schema, {{"twosided", "true"}});
    scene.add(
        plugin.create(p.set(), AreaLightContext{build.base(), *shape, images, build.textures}));
  }
  DistributionMaker maker;
  for (const auto& form : kForms) {
    const auto d = maker.make("bvh", scene, form);
    for (size_t i = 0; i < scene.shapes.size(); ++i) {
      LightSampleContext c;
      c.p = Vec3(static_cast<float>(i) * 5 + 0.3f, 2.5f, 0.2f);
      double sum = 0, largest = 0;
      for (LightId l = 0; l < scene.table.size(); ++l) {
        const auto pmf = static_cast<double>(d->pmf(c, l));
        ASSERT_GT(pmf, 0);
        sum += pmf;
        largest = std::max(largest, pmf);
      }
      EXPECT_NEAR(sum, 1, 1e-4);
      EXPECT_EQ(static_cast<double>(d->pmf(c, static_cast<LightId>(i))), largest) << i;
    }
  }
}

// Cycles: an emitter counts by its area, wherever its picture is dark.
TEST(BvhFault, TexturedEmittersCountAlike) {
  const auto scene = sceneNamed("picture");
  DistributionMaker maker;
  LightSampleContext c;
  c.p = {0.5f, 0.5f, 20};
  for (const auto& form : kForms) {
    const auto d = maker.make("bvh", *scene, form);
    double total = 0;
    std::vector<double> means(scene->table.size());
    for (LightId l = 0; l < means.size(); ++l) {
      for (uint64_t i = 0; i < 256; ++i)
        means[l] += contribution(*scene, c, l, {uniform(5, i, l), uniform(6, i, l)}) / 256;
      total += means[l];
      // Some triangles show black only.
      const auto bounds = scene->table[l].light->bounds(scene->table[l].element);
      if (!(bounds->intensity > 0)) {
        EXPECT_EQ(means[l], 0);
        EXPECT_EQ(d->pmf(c, l), 0);
      }
    }
    for (LightId l = 0; l < means.size(); ++l) {
      if (means[l] > 0.02 * total) {
        EXPECT_NEAR(static_cast<double>(d->pmf(c, l)), means[l] / total, 0.3 * means[l] / total);
      }
    }
  }
}

}  // namespace
}  // namespace lampyris::test
