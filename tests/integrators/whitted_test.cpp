// SPDX-License-Identifier: Apache-2.0
// "whitted" and "ambientocclusion".
#include <cmath>

#include "integrator_comparison.h"

namespace lampyris::test {

namespace {

TEST(Whitted, EqualsDirectLighting) {
  expectSameMean(R"("whitted")", R"("directlighting")", room(), 256);
  const std::string mirrors = room() +
                              "AttributeBegin\nMaterial \"glass\"\nTranslate 0.4 0.3 0.3\n"
                              "Shape \"sphere\" \"float radius\" 0.3\nAttributeEnd\n";
  expectSameMean(R"("whitted" "integer maxdepth" 3)", R"("directlighting" "integer maxdepth" 3)",
                 mirrors, 256);
}

TEST(Whitted, TakesOneSampleOfALightWhateverItWishes) {
  const auto render = [](const std::string& light) {
    TinyScene scene(tinyScene(roomView(R"("whitted")"), light + room()));
    scene.render(2);
    return scene.film().save();
  };
  EXPECT_EQ(render("LightSource \"infinite\" \"integer nsamples\" 1\n"),
            render("LightSource \"infinite\" \"integer nsamples\" 7\n"));
}

TinyView openView(const std::string& parameters) {
  TinyView v;
  v.integrator = "\"ambientocclusion\" " + parameters;
  return v;
}
std::vector<double> occlusion(const TinyView& view, const std::string& world,
                              uint64_t samples = 16) {
  TinyScene scene(tinyScene(view, world));
  scene.render(samples);
  EXPECT_EQ(scene.badSamples(), 0);
  return scene.greens();
}

TEST(AmbientOcclusion, IsPiInTheOpen) {
  for (const double v : occlusion(openView("\"integer nsamples\" 3"), matte(0.5f) + square(1)))
    EXPECT_NEAR(v, M_PI, 1e-6);
  const std::string uniform = "\"bool cossample\" \"false\" \"integer nsamples\" 8";
  EXPECT_EQ(meanTest(occlusion(openView(uniform), matte(0.5f) + square(1)), M_PI, 1e-4), "");
}

TEST(AmbientOcclusion, IsTheFormFactorOfTheSky) {
  // A disk of radius 1 at distance 1 hides half of the cosine-weighted hemisphere.
  TinyView view;
  view.lookAt = "5 0 5  0 0 0  0 0 1";
  const std::string world = matte(0.5f) + square(0.5f) + "Translate 0 0 1\nShape \"disk\"\n";
  for (const char* cosine : {"true", "false"}) {
    view.integrator =
        std::string("\"ambientocclusion\" \"integer nsamples\" 4 \"bool cossample\" \"") + cosine +
        "\"";
    view.lookAt = "3 0 0.75  0 0 0  0 0 1";
    EXPECT_EQ(meanTest(occlusion(view, world, 64), M_PI / 2, 2e-3), "") << cosine;
  }
}

TEST(AmbientOcclusion, PassesInterfacesOnTheWayButNotTheSky) {
  const std::string pane = "AttributeBegin\nMaterial \"\"\nTranslate 0 0 1\n" + square(50) +
                           "AttributeEnd\n" + matte(0.5f) + square(1);
  TinyView view = openView("\"integer nsamples\" 4");
  for (const double v : occlusion(view, pane)) EXPECT_LT(v, 0.1);
  for (const double v : occlusion(view, "")) EXPECT_EQ(v, 0);
}

TEST(AmbientOcclusion, ChecksItsParameters) {
  EXPECT_THROW(TinyScene(tinyScene(openView("\"integer nsamples\" 0"), "")), SceneError);
  TinyScene scene(
      tinyScene(openView("\"integer pixelbounds\" [2 4 3 4]"), matte(0.5f) + square(1)));
  scene.render(1);
  uint64_t samples = 0;
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 8; ++x) samples += scene.film().sampleCount({x, y});
  EXPECT_EQ(samples, 2u);
  TinyScene wrong(tinyScene(openView("\"integer pixelbounds\" [2 4]"), ""));
  EXPECT_THROW(wrong.render(1), SceneError);
}

}  // namespace

}  // namespace lampyris::test
