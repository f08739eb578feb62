// SPDX-License-Identifier: Apache-2.0
#include "scene/builder.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "core/parallel.h"
#include "scene_test.h"
#include "support/tiny_scenes.h"

namespace lampyris::test {
namespace {

TEST(Builder, DefaultsRenderAnEmptyWorld) {
  Reader r;
  const auto job = r.build("WorldBegin WorldEnd");
  EXPECT_EQ(job->film->resolution(), Int2(1280, 720));
  EXPECT_TRUE(job->camera && job->sampler && job->integrator && job->scene.geometry);
  EXPECT_EQ(job->scene.lightTable.size(), 0u);
  EXPECT_FALSE(job->scene.bounds.empty());
  EXPECT_TRUE(r.warnings.empty()) << r.warnings[0];
}

TEST(Builder, IsTheSameForAnyNumberOfThreads) {
  // As many lights, shapes and emitting triangles as several threads share.
  std::string text = "LightSource \"infinite\"\n";
  for (int i = 0; i < 20'000; ++i)
    text += fmt::format("LightSource \"point\" \"point from\" [{} {} 3] \"rgb I\" [{} 1 1]\n",
                        i % 141, i / 141, i % 7);
  std::string points, indices;
  for (int y = 0; y <= 100; ++y)
    for (int x = 0; x <= 100; ++x) {
      points += fmt::format("{} {} {} ", x, y, (x * y) % 5);
      const int a = y * 101 + x;
      if (x < 100 && y < 100)
        indices += fmt::format("{} {} {} {} {} {} ", a, a + 1, a + 102, a, a + 102, a + 101);
    }
  text += "AttributeBegin AreaLightSource \"diffuse\"\nShape \"trianglemesh\" \"point P\" [" +
          points + "] \"integer indices\" [" + indices + "]\nAttributeEnd\n";
  text += "Material \"kdsubsurface\"\n";
  for (int i = 0; i < 50; ++i) text += "Translate 0 0 1\nShape \"sphere\"\n";
  const auto image = [&text](int threads) {
    const ThreadLimit limit(threads);
    TinyScene scene(tinyScene({}, text));
    EXPECT_GT(scene.job().scene.lightTable.size(), 39'000u);
    scene.render(1);
    return scene.film().save();
  };
  const std::string one = image(1);
  EXPECT_TRUE(image(2) == one);
  EXPECT_TRUE(image(8) == one);
}

TEST(Builder, EveryRegistryIsListedOnce) {
  std::vector<std::string> kinds;
  for (const RegistryInfo* info : allRegistries()) {
    EXPECT_EQ(std::count(kinds.begin(), kinds.end(), info->kind()), 0) << info->kind();
    kinds.push_back(info->kind());
  }
  EXPECT_EQ(kinds.size(), 13u);
}

TEST(Builder, LightsHaveTheFilesOrder) {
  Reader r;
  const auto job = r.build(world(
      std::string("LightSource \"point\" \"point from\" [1 0 0]\n"
                  "AttributeBegin AreaLightSource \"diffuse\" ") +
      kTriangle + kTriangle +
      "AttributeEnd LightSource \"point\" \"rgb I\" [0 0 0] LightSource \"point\" \"point from\" "
      "[2 0 0] Translate 3 0 0 LightSource \"point\""));
  const LightTable& table = job->scene.lightTable;
  ASSERT_EQ(table.size(), 5u);
  EXPECT_EQ(table[0].light->bounds(0)->box.min.x, 1);
  EXPECT_FALSE(table[1].light->isDelta());
  EXPECT_FALSE(table[2].light->isDelta());
  EXPECT_EQ(table[3].light->bounds(0)->box.min.x, 2);
  EXPECT_EQ(table[4].light->bounds(0)->box.min.x, 3);
  EXPECT_EQ(r.statistics.value("scene", "lights dropped (no power)"), 1);
  EXPECT_EQ(r.statistics.value("scene", "lights"), 5);
  EXPECT_EQ(r.statistics.value("scene", "triangles"), 2);
}

TEST(Builder, PrimitivesKnowTheirLight) {
  Reader r;
  const auto job =
      r.build(world(std::string("LightSource \"point\" AreaLightSource \"diffuse\" ") + kTriangle));
  const Ray ray{{.2f, .2f, 5}, {0, 0, -1}};
  const auto hit = job->scene.geometry->intersect(ray);
  ASSERT_TRUE(hit);
  const Primitive& p = job->scene.geometry->primitive(*hit);
  EXPECT_EQ(p.lightId(hit->element), 1u);
  EXPECT_EQ(p.light, job->scene.lightTable[1].light);
  EXPECT_NE(p.material, nullptr);
}

TEST(Builder, EmitterWithoutPowerIsAnOrdinarySurface) {
  Reader r;
  const auto job =
      r.build(world(std::string("AreaLightSource \"diffuse\" \"rgb L\" [0 0 0] ") + kTriangle));
  const auto hit = job->scene.geometry->intersect({{.2f, .2f, 5}, {0, 0, -1}});
  ASSERT_TRUE(hit);
  EXPECT_EQ(job->scene.geometry->primitive(*hit).light, nullptr);
  EXPECT_EQ(job->scene.lightTable.size(), 0u);
}

TEST(Builder, InfiniteLightsAreListed) {
  Reader r;
  const auto job = r.build(world(std::string("LightSource \"distant\" LightSource \"infinite\" "
                                             "LightSource \"infinite\" \"rgb L\" [0 0 0] ") +
                                 kTriangle));
  ASSERT_EQ(job->scene.infiniteLights.size(), 1u);
  EXPECT_EQ(job->scene.infiniteLightIds[0], 1u);
  EXPECT_EQ(job->scene.lightTable.size(), 2u);
}

TEST(Builder, BackgroundOfAnEmptySceneIsSeen) {
  Reader r;
  const auto job = r.build(world("LightSource \"infinite\""));
  ASSERT_EQ(job->scene.infiniteLights.size(), 1u);
  EXPECT_FALSE(job->scene.infiniteLights[0]->escaped({0, 0, 1}).isBlack());
}

TEST(Builder, InstancesArePlacedAndCountInTheBounds) {
  Reader r;
  const auto job = r.build(
      world(std::string("ObjectBegin \"unused\" Shape \"nosuchshape\" ObjectEnd ObjectBegin \"o\" "
                        "Translate 0 0 1 AreaLightSource \"diffuse\" ") +
            kTriangle +
            "ObjectEnd Translate 10 0 0 ObjectInstance \"o\" Translate 10 0 0 "
            "ObjectInstance \"o\""));
  EXPECT_NEAR(job->scene.bounds.min.x, 10, 1e-4);
  EXPECT_NEAR(job->scene.bounds.max.x, 21, 1e-4);
  const auto hit = job->scene.geometry->intersect({{20.2f, .2f, 5}, {0, 0, -1}});
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->shape.t, 4, 1e-4);
  const Primitive& p = job->scene.geometry->primitive(*hit);
  EXPECT_NE(p.light, nullptr);
  EXPECT_EQ(p.firstLight, kNoLight);
  EXPECT_EQ(job->scene.lightTable.size(), 0u);
  ASSERT_EQ(r.warnings.size(), 1u);
  EXPECT_NE(r.warnings[0].find("area light in an object"), std::string::npos);
  EXPECT_EQ(r.statistics.value("scene", "shapes skipped (of unused objects)"), 1);
}

TEST(Builder, WarnsOnceOfWhatIsNotRenderedYet) {
  Reader r;
  r.build(
      world("ActiveTransform EndTime Translate 1 0 0 LightSource \"point\" LightSource "
            "\"point\""));
  ASSERT_EQ(r.warnings.size(), 1u);
  EXPECT_NE(r.warnings[0].find("this stands where it is at the start time"), std::string::npos);
}

TEST(Builder, ManyLightsLoad) {
  std::string content;
  for (int i = 0; i < 100'000; ++i)
    content +=
        fmt::format("LightSource \"point\" \"point from\" [ {} {} {} ] \"color I\" [ 1 {} 1 ]\n",
                    i % 317, i % 101, i / 1000, i % 7);
  Reader r;
  const auto job = r.build(world(content + kTriangle));
  ASSERT_EQ(job->scene.lightTable.size(), 100'000u);
  for (const LightId id : {0u, 1u, 54'321u, 99'999u}) {
    const Vec3 p = job->scene.lightTable[id].light->bounds(0)->box.min;
    EXPECT_EQ(p, Vec3(id % 317, id % 101, id / 1000));
  }
}

}  // namespace
}  // namespace lampyris::test
