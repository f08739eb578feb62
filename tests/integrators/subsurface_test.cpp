// SPDX-License-Identifier: Apache-2.0
// Subsurface scattering of planes, where the radiance is known: under a white sky light that enters
// anywhere is worth the same, so the profile counts by its integral alone.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "support/statistics.h"
#include "support/tiny_scenes.h"

namespace lampyris::test {
namespace {

constexpr const char* kSky = "LightSource \"infinite\" \"rgb L\" [1 1 1]\n";
/// Fresnel's reflectance at normal incidence.
double mirrored(double eta) { return (eta - 1) * (eta - 1) / ((eta + 1) * (eta + 1)); }

std::vector<double> render(const std::string& world, uint64_t samples = 64, TinyView view = {}) {
  TinyScene scene(tinyScene(view, world));
  scene.render(samples);
  EXPECT_EQ(scene.badSamples(), 0);
  EXPECT_EQ(scene.warnings(), "");
  return scene.greens();
}

std::string body(double kd, double mfp, double eta) {
  return fmt::format(
      "Material \"kdsubsurface\" \"rgb Kd\" [{0} {0} {0}] \"rgb mfp\" [{1} {1} {1}] \"float eta\" "
      "{2}\n",
      kd, mfp, eta);
}

TEST(Subsurface, APlaneUnderTheSkyShowsItsColour) {
  for (const double eta : {1., 1.4})
    for (const double kd : {0.3, 0.8}) {
      const double f = mirrored(eta);
      // A thousandth of the profile lies beyond what is probed.
      EXPECT_EQ(meanTest(render(kSky + body(kd, 0.01, eta) + square(10)), f + (1 - f) * kd, 4e-3),
                "")
          << eta << " " << kd;
    }
}

TEST(Subsurface, DisneysScatterDistanceTakesTheDiffusePartsPlace) {
  const std::string material =
      "Material \"disney\" \"rgb color\" [.6 .6 .6] \"rgb scatterdistance\" [.05 .05 .05] "
      "\"float eta\" 1 \"float roughness\" 0\n";
  EXPECT_EQ(meanTest(render(kSky + material + square(10)), 0.6, 4e-3), "");
}

TEST(Subsurface, DoesNotDependOnTheUnitOfLength) {
  for (const double unit : {1e-4, 1e4}) {
    TinyView view;
    view.lookAt = fmt::format("0 0 {0}  0 0 0  0 1 0", unit);
    view.camera =
        fmt::format(R"("orthographic" "float screenwindow" [-{0} {0} -{0} {0}])", 1e-3 * unit);
    const auto values =
        render(kSky + body(0.5, 0.01 * unit, 1) + square(static_cast<float>(10 * unit)), 64, view);
    EXPECT_EQ(meanTest(values, 0.5, 4e-3), "") << unit;
  }
}

TEST(Subsurface, ProbesPassWhatIsOfAnotherMaterial) {
  const std::string hidden =
      "AttributeBegin\nTranslate 0 0 -0.01\n" + matte(0.5f) + square(10) + "AttributeEnd\n";
  EXPECT_EQ(meanTest(render(kSky + hidden + body(0.6, 0.1, 1) + square(10)), 0.6, 4e-3), "");
}

TEST(Subsurface, OneOfSeveralSheetsIsDrawnFairly) {
  // Half of the entries are on the sheet below, which no light reaches without another bounce.
  TinyView view;
  view.integrator = R"("path" "integer maxdepth" 1)";
  const std::string sheets = body(0.6, 0.1, 1) + square(10) + "Translate 0 0 -1e-4\n" + square(10);
  EXPECT_EQ(meanTest(render(kSky + sheets, 64, view), 0.6, 4e-3), "");
}

TEST(Subsurface, LightSamplingAndRaysAgree) {
  // A distant light is found by light sampling alone: irradiance 1 from above enters by 1 − F and
  // leaves diffusely, in proportion to what the boundary lets in of diffuse light.
  const double eta = 1.4, f = mirrored(eta);
  const std::string sun =
      "LightSource \"distant\" \"rgb L\" [1 1 1] \"point from\" [0 0 1] \"point to\" [0 0 0]\n";
  TinyView view;
  view.integrator = R"("path" "integer maxdepth" 1)";
  // Duntley's diffuse reflectance for 1.4 is 0.0768.
  const double expected = (1 - f) * 0.5 * (1 - f) / (1 - 0.0768) / M_PI;
  EXPECT_EQ(meanTest(render(sun + body(0.5, 0.01, eta) + square(10), 64, view), expected, 2e-3),
            "");
}

TEST(Subsurface, ShowsThroughThinBodies) {
  // Lit from behind only: a slab glows the more the farther light goes in it.
  const auto glow = [](double mfp) {
    const std::string world =
        "LightSource \"distant\" \"rgb L\" [1 1 1] \"point from\" [0 0 -1] \"point to\" [0 0 0]\n" +
        body(0.8, mfp, 1.3) + square(10) + "Translate 0 0 -0.1 Rotate 180 1 0 0\n" + square(10);
    double sum = 0;
    for (const double v : render(world, 256)) sum += v / 64;
    return sum;
  };
  const double thick = glow(0.01), thin = glow(0.1);
  EXPECT_GT(thin, 0.005);
  EXPECT_GT(thin, 4 * thick);
}

TEST(Subsurface, GivesTheSameImageWhateverTheThreads) {
  const std::string world =
      kSky + body(0.5, 0.3, 1.3) + "Shape \"sphere\" \"float radius\" 0.0005\n";
  EXPECT_EQ(render(world, 16), render(world, 16));
}

TEST(Subsurface, ABlackMediumScattersNothing) {
  const std::string clear =
      "Material \"subsurface\" \"rgb sigma_a\" [0 0 0] \"rgb sigma_s\" [0 0 0] \"float eta\" 1\n";
  for (const double v : render(kSky + clear + square(10))) EXPECT_EQ(v, 0);
}

}  // namespace
}  // namespace lampyris::test
