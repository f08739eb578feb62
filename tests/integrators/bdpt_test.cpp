// SPDX-License-Identifier: Apache-2.0
// Bidirectional path tracing against path tracing, over lights, cameras and materials.
#include "core/parallel.h"
#include "integrator_comparison.h"

namespace lampyris::test {

namespace {

/// `world` by "bdpt" and by "path", for the view's camera.
void expectPathsImage(const std::string& world, int depth, uint64_t samples, uint64_t pathSamples,
                      TinyView view = roomView("")) {
  TinyView reference = view;
  view.integrator = withDepth("bdpt", depth);
  reference.integrator = withDepth("path", depth);
  expectSameMean(view, reference, world, samples, pathSamples);
}

TEST(Bdpt, EqualsPathAtEveryDepth) {
  for (const int depth : {0, 1, 2, 5}) expectPathsImage(room(), depth, 64, 128);
}

TEST(Bdpt, EqualsPathForEveryLight) {
  expectPathsImage(ballUnder(R"("point" "point from" [0.3 0 1])"), 3, 64, 64);
  for (const std::string& light : kLightsAbove) expectPathsImage(ballUnder(light), 3, 64, 64);
  expectPathsImage(
      "LightSource \"infinite\" \"rgb L\" [0.5 0.5 0.5]\n"
      "LightSource \"distant\" \"point from\" [1 0 2] \"point to\" [0 0 0]\n" +
          room(),
      4, 64, 128);
}

TEST(Bdpt, TwoSidedAndUnsampledEmittersCount) {
  const std::string lamp =
      "AttributeBegin\nAreaLightSource \"diffuse\" \"rgb L\" [4 4 4] \"bool twosided\" \"true\"\n"
      "Translate 0 0 0.7\n" +
      square(0.3f) + "AttributeEnd\n" + matte(0.7f) + square(2) +
      "AttributeBegin\nTranslate 0 0 2\n" + square(2) + "AttributeEnd\n";
  expectPathsImage(lamp, 3, 64, 64);
}

TEST(Bdpt, EqualsPathThroughGlassAndGloss) {
  expectPathsImage(
      "LightSource \"infinite\" \"rgb L\" [0.3 0.3 0.3]\n" + glassRoom() +
          "Material \"glass\" \"float uroughness\" 0.3 \"float vroughness\" 0.3\n"
          "AttributeBegin\nTranslate 0 0.8 0.35\nShape \"sphere\" \"float radius\" 0.3\n"
          "AttributeEnd\n",
      6, 128, 512);
}

TEST(Bdpt, ShadingNormalsChangeNothing) {
  // A coarse grid with normals that are bent away from its faces.
  const std::string bent =
      "AttributeBegin\n" + matte(0.7f) +
      "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point P\" [-1 -1 0.2 1 -1 0.2 1 "
      "1 0.2 -1 1 0.2] \"normal N\" [-0.6 -0.2 1 0.6 0.1 1 0.5 0.6 1 -0.5 0.4 1]\nAttributeEnd\n";
  expectPathsImage(room() + bent, 3, 64, 128);
}

TEST(Bdpt, EqualsPathForEveryCamera) {
  for (const std::string& camera : kCameras) {
    TinyView view = roomView("");
    view.camera = camera;
    expectPathsImage(room(), 3, 64, 128, view);
  }
}

TEST(Bdpt, CamerasThatScaleMirrorAndShearSeeTheSame) {
  for (const std::string transform : {"Scale -1 1 1\n", "Scale 3 3 3\n", "Scale 1 2 1.5\n"}) {
    const auto scene = [&](const char* integrator) {
      return transform + tinyScene(roomView(withDepth(integrator, 3)), room());
    };
    expectSameMean(scene("bdpt"), scene("path"), 64, 64);
  }
}

TEST(Bdpt, FiltersSpreadSplatsAsTheySpreadSamples) {
  for (const std::string filter : {"\"gaussian\"", "\"mitchell\""}) {
    const auto scene = [&](const char* integrator) {
      std::string text = tinyScene(roomView(withDepth(integrator, 2)), room());
      return text.replace(text.find("\"box\""), 5, filter);
    };
    expectSameMean(scene("bdpt"), scene("path"), 128, 128);
  }
}

TEST(Bdpt, InterfacesAreInvisible) {
  const std::string pane = "AttributeBegin\nMaterial \"\"\nTranslate 0 0 1.3\n" + square(3) +
                           "AttributeEnd\n" +
                           "AttributeBegin\nMaterial \"\"\nTranslate 0.2 -0.3 "
                           "0.4\nShape \"sphere\" \"float radius\" 0.35\nAttributeEnd\n";
  const TinyView view = roomView(withDepth("bdpt", 3));
  expectSameMean(tinyScene(view, room() + pane), tinyScene(view, room()), 64, 64);
}

TEST(Bdpt, SmallAndLargeScenesLookTheSame) {
  for (const float scale : {1e-4f, 1e4f}) {
    TinyView view;
    view.integrator = withDepth("bdpt", 3);
    view.lookAt = "0 0 0  0 0 1  0 1 0";
    view.camera = R"("perspective" "float fov" 90)";
    const std::string s = std::to_string(scale);
    TinyScene scene(tinyScene(view, matte(0.5f) + "Scale " + s + " " + s + " " + s +
                                        "\nAreaLightSource \"diffuse\" \"rgb L\" [1 1 1]\n"
                                        "ReverseOrientation\nShape \"sphere\"\n"));
    scene.render(64);
    EXPECT_EQ(meanTest(scene.greens(), 1.875, 2e-3), "") << scale;
  }
}

TEST(Bdpt, PartsOfTheImageAreThoseOfTheWhole) {
  const auto mean = [](const std::string& extra, const std::vector<float>& crop) {
    BuildOptions options;
    options.cropWindow = crop;
    TinyScene scene(tinyScene(roomView(withDepth("bdpt", 3) + extra), room()), options);
    scene.render(256);
    double sum = 0;
    for (int y = 4; y < 12; ++y)
      for (int x = 4; x < 12; ++x) sum += static_cast<double>(scene.film().pixel({x, y}).g);
    return sum;
  };
  const double whole = mean("", {});
  EXPECT_NEAR(mean("", {0.25f, 0.75f, 0.25f, 0.75f}) / whole, 1, 0.05);
  EXPECT_NEAR(mean(" \"integer pixelbounds\" [4 12 4 12]", {}) / whole, 1, 0.05);
}

TEST(Bdpt, ResumesToTheSameBits) {
  const std::string text = tinyScene(roomView(withDepth("bdpt", 3)), room());
  TinyScene whole(text), first(text), second(text);
  whole.render(6);
  first.render(2);
  ASSERT_TRUE(second.film().restore(first.film().save()));
  RenderOptions options;
  options.firstSample = 2;
  options.sampleCount = 6;
  second.render(options);
  EXPECT_EQ(whole.film().save(), second.film().save());
  std::string damaged = first.film().save();
  damaged[damaged.size() / 2] ^= 1;
  EXPECT_FALSE(TinyScene(text).film().restore(damaged));
}

TEST(Bdpt, ChecksItsParameters) {
  EXPECT_THROW(TinyScene(tinyScene(roomView("\"bdpt\" \"integer maxdepth\" -1"), "")), SceneError);
  TinyScene visualize(
      tinyScene(roomView("\"bdpt\" \"bool visualizestrategies\" \"true\""), room()));
  EXPECT_NE(visualize.warnings().find("visualizestrategies"), std::string::npos);
}

}  // namespace

}  // namespace lampyris::test
