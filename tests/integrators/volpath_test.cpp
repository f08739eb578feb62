// SPDX-License-Identifier: Apache-2.0
// Volumetric path tracing against closed forms and against "path".
#include <gtest/gtest.h>

#include "support/statistics.h"
#include "support/tiny_scenes.h"

namespace lampyris::test {

namespace {

std::string medium(const std::string& absorption, const std::string& scattering,
                   const std::string& more = "") {
  return "MakeNamedMedium \"m\" \"string type\" \"homogeneous\" \"rgb sigma_a\" [" + absorption +
         "] \"rgb sigma_s\" [" + scattering + "] " + more + "\n";
}

const std::string kBall =
    "AttributeBegin\nMediumInterface \"m\" \"\"\nMaterial \"\"\nShape \"sphere\"\nAttributeEnd\n";
const std::string kSky = "LightSource \"infinite\" \"rgb L\" [1 1 1]\n";

std::vector<double> render(const std::string& world, uint64_t samples,
                           const std::string& integrator = R"("volpath" "integer maxdepth" 200)") {
  TinyView view;
  view.integrator = integrator;
  TinyScene scene(tinyScene(view, world));
  EXPECT_EQ(scene.warnings(), "");
  scene.render(samples);
  EXPECT_EQ(scene.badSamples(), 0);
  return scene.greens();
}

TEST(Volpath, AbsorptionFollowsBeersLaw) {
  // Through the middle of a ball of radius 1.
  const auto seen = render(medium("0 0.7 0", "0 0 0") + kBall + kSky, 64);
  EXPECT_EQ(meanTest(seen, std::exp(-1.4), 1e-5), "");
}

TEST(Volpath, FurnaceIsWhite) {
  // What only scatters, in light that is the same from everywhere, is invisible.
  for (const std::string g : {"0", "0.8", "-0.6"}) {
    const auto seen = render(medium("0 0 0", "2 2 2", "\"float g\" " + g) + kBall + kSky, 64,
                             R"("volpath" "integer maxdepth" 2000 "float rrthreshold" 0)");
    EXPECT_EQ(meanTest(seen, 1, 1e-4), "") << g;
  }
}

TEST(Volpath, SingleScatteringOfADistantLight) {
  // A camera in an endless fog looks along −z; light comes along −z too, from behind: isotropic
  // single scattering gives ∫ σs/4π E exp(−σ z) dz with all the light unabsorbed in front of a wall
  // of light. Here: a slab −1 < z < 1 lit from +z; path at depth z has come 1 − z both ways.
  const std::string slab =
      "AttributeBegin\nMediumInterface \"m\" \"\"\nMaterial \"\"\n"
      "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point P\" [-900 -900 1 900 -900 "
      "1 900 900 1 -900 900 1]\nReverseOrientation\nShape \"trianglemesh\" \"integer indices\" [0 "
      "1 2 0 2 3] \"point P\" [-900 -900 -1 900 -900 -1 900 900 -1 -900 900 -1]\nAttributeEnd\n";
  const auto seen = render(
      medium("0 0.3 0", "0 0.5 0") + slab +
          "LightSource \"distant\" \"rgb L\" [3 3 3] \"point from\" [0 0 1] \"point to\" [0 0 0]\n",
      256, R"("volpath" "integer maxdepth" 1)");
  const double expected = 3 * 0.5 / (4 * 3.14159265358979) * (1 - std::exp(-0.8 * 4)) / 1.6;
  EXPECT_EQ(meanTest(seen, expected, 1e-5), "");
}

TEST(Volpath, WithoutMediaItIsPath) {
  const std::string world =
      "AttributeBegin\nAreaLightSource \"diffuse\" \"rgb L\" [4 4 4]\n"
      "Translate 0 0 2\nRotate 180 1 0 0\n" +
      square(0.4f) + "AttributeEnd\n" + matte(0.7f) + square(2) + kSky;
  auto a = render(world, 512), b = render(world, 512, R"("path" "integer maxdepth" 200)");
  for (size_t i = 0; i < a.size(); ++i) a[i] -= b[i];
  EXPECT_EQ(meanTest(a, 0, 1e-5), "");
}

TEST(Volpath, LightPassesInterfaces) {
  const std::string lamp = "LightSource \"point\" \"point from\" [0 0 3] \"rgb I\" [9 9 9]\n";
  const std::string pane =
      "AttributeBegin\nTranslate 0 0 1\nMaterial \"\"\n" + square(9) + "AttributeEnd\n";
  const std::string plane = matte(0.5f) + square(0.5f);
  const auto open = render(lamp + plane, 16), covered = render(lamp + pane + plane, 16);
  for (size_t i = 0; i < open.size(); ++i) EXPECT_NEAR(covered[i], open[i], 1e-5 * open[i]);
}

TEST(Volpath, MediaAreFoundByTheirNames) {
  const auto error = [](const std::string& world) -> std::string {
    try {
      TinyScene scene(tinyScene({}, world));
    } catch (const SceneError& e) {
      return e.what();
    }
    return "";
  };
  const std::string use = "MediumInterface \"fgo\" \"\"\nShape \"sphere\"\n";
  EXPECT_NE(error(use).find("medium \"fgo\" is not defined before its use"), std::string::npos);
  EXPECT_NE(error("MakeNamedMedium \"fog\" \"string type\" \"homogeneous\"\n" + use)
                .find("did you mean \"fog\""),
            std::string::npos);
  // As in pbrt-v3, what stands at WorldEnd is around the camera.
  TinyScene scene(tinyScene({}, medium("0 0 0", "1 1 1") + "MediumInterface \"\" \"m\"\n"));
  EXPECT_NE(scene.job().scene.cameraMedium, nullptr);
  // What nothing names is not built; "path" says that it ignores media.
  TinyScene unused(tinyScene({}, medium("0 0 0", "1 1 1") + square(1)));
  EXPECT_TRUE(unused.job().scene.media.empty());
  EXPECT_EQ(unused.warnings(), "");
  TinyScene ignored(tinyScene({}, medium("0 0 0", "1 1 1") + kBall));
  EXPECT_NE(ignored.warnings().find("does not render participating media"), std::string::npos);
}

}  // namespace

}  // namespace lampyris::test
