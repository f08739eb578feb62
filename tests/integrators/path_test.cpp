// SPDX-License-Identifier: Apache-2.0
// Path tracing against itself: settings that must not change the expected image, and rules of
// pbrt-v3 that must hold.
#include "integrator_comparison.h"
#include "lightdistributions/registry.h"

namespace lampyris::test {

namespace {

const std::string kRoom = room();

TEST(Path, EqualsDirectLightingAtDepthOne) {
  const std::string path = R"("path" "integer maxdepth" 1)";
  expectSameMean(path, R"("directlighting" "integer maxdepth" 1)", kRoom, 128);
  expectSameMean(path, R"("directlighting" "integer maxdepth" 1 "string strategy" "one")", kRoom,
                 128);
}

TEST(Path, RouletteIsUnbiased) {
  expectSameMean(R"("path" "integer maxdepth" 12 "float rrthreshold" 1)",
                 R"("path" "integer maxdepth" 12 "float rrthreshold" 0)", kRoom, 64);
}

TEST(Path, LightSamplersAgree) {
  const std::string first = lightDistributionRegistry().entries().front().name;
  for (const auto& entry : lightDistributionRegistry().entries())
    expectSameMean("\"path\" \"string lightsampler\" \"" + first + "\"",
                   "\"path\" \"string lightsampler\" \"" + entry.name + "\"", kRoom, 64);
}

TEST(Path, PathTreeIsPathWithTheTree) {
  TinyScene tree(tinyScene(roomView(R"("pathtree" "string lightsamplestrategy" "1.0")"), kRoom));
  TinyScene path(tinyScene(roomView(R"("path" "string lightsampler" "bvh")"), kRoom));
  tree.render(4);
  path.render(4);
  EXPECT_EQ(tree.film().save(), path.film().save());
  EXPECT_EQ(tree.warnings(), "");
  const char* const split = R"("pathtree" "string lightsamplestrategy" "0.5")";
  EXPECT_EQ(TinyScene(tinyScene(roomView(split), kRoom)).warnings(), "");
  expectSameMean(split, R"("path" "string lightsampler" "bvh")", kRoom, 64);
  EXPECT_THROW(
      TinyScene(tinyScene(roomView(R"("pathtree" "string lightsamplestrategy" "1.5")"), kRoom)),
      SceneError);
  TinyScene(tinyScene(roomView(R"("pathtree" "string lightsamplestrategy" "uniform")"), kRoom));
}

TEST(Path, SplittingIsUnbiased) {
  for (const char* splitting : {R"("float splitthreshold" .2 "integer maxcut" 2)",
                                R"("float splitthreshold" .7 "integer maxcut" 8)",
                                R"("float splitthreshold" 0 "integer maxcut" 100)"})
    expectSameMean(R"("path" "string lightsampler" "uniform")",
                   std::string(R"("path" "string lightsampler" "bvh" )") + splitting, kRoom, 64);
}

/// Mean of a view from above on a plane, with `between` at z = 1.
double planeUnder(const std::string& light, const std::string& between, const std::string& plane) {
  TinyView view;
  view.integrator = R"("path" "integer maxdepth" 4)";
  TinyScene scene(tinyScene(view, light + "AttributeBegin\nTranslate 0 0 1\nMaterial \"\"\n" +
                                      between + "AttributeEnd\n" + plane + square(0.5f)));
  scene.render(16);
  double sum = 0;
  for (const double g : scene.greens()) sum += g;
  return sum / static_cast<double>(scene.greens().size());
}

TEST(Path, InterfacesBlockLightButNotSight) {
  const std::string lamp = "LightSource \"point\" \"point from\" [0 0 3] \"rgb I\" [9 9 9]\n";
  const std::string sky = "LightSource \"infinite\" \"rgb L\" [1 1 1]\n";
  EXPECT_GT(planeUnder(lamp, "", matte(0.5f)), 0.1);
  EXPECT_EQ(planeUnder(lamp, square(9), matte(0.5f)), 0);
  // Emission found through an interface after a diffuse bounce does not count either …
  const std::string dome = "Shape \"sphere\" \"float radius\" 3\n";
  EXPECT_EQ(planeUnder(sky, dome, matte(0.5f)), 0);
  // … but it does after a specular one, and the interface is no bounce.
  EXPECT_NEAR(planeUnder(sky, dome, "Material \"mirror\" \"rgb Kr\" [1 1 1]\n"), 1, 1e-5);
}

TEST(Path, ManyInterfacesEnd) {
  std::string many;
  for (int i = 0; i < 50; ++i) many += square(9);
  const std::string sky = "LightSource \"infinite\" \"rgb L\" [1 1 1]\n";
  const double seen = planeUnder(sky, many, "Material \"mirror\" \"rgb Kr\" [1 1 1]\n");
  EXPECT_GE(seen, 0);
  EXPECT_LE(seen, 1 + 1e-5);
}

TEST(Path, ScaleOfTheSceneDoesNotMatter) {
  // Positions times s: emitters keep their radiance, so the image stays the same.
  const auto furnaceMean = [](float scale) {
    TinyView view;
    view.integrator = R"("path" "integer maxdepth" 3)";
    view.lookAt = "0 0 0  0 0 1  0 1 0";
    view.camera = R"("perspective" "float fov" 90)";
    const std::string s = std::to_string(scale);
    TinyScene scene(tinyScene(view, matte(0.5f) + "Scale " + s + " " + s + " " + s +
                                        "\nAreaLightSource \"diffuse\" \"rgb L\" [1 1 1]\n"
                                        "ReverseOrientation\nShape \"sphere\"\n"));
    scene.render(64);
    return scene.greens();
  };
  for (const float scale : {1e-4f, 1.f, 1e4f})
    EXPECT_EQ(meanTest(furnaceMean(scale), 1.875, 2e-3), "") << scale;
}

}  // namespace

}  // namespace lampyris::test
