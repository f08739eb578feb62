// SPDX-License-Identifier: Apache-2.0
// Scenes whose radiance is known in closed form, for all integrators and samplers.
#include <gtest/gtest.h>

#include <cmath>

#include "integrators/registry.h"
#include "samplers/registry.h"
#include "support/statistics.h"
#include "support/tiny_scenes.h"

namespace lampyris::test {

namespace {

std::string quoted(const std::string& name) { return "\"" + name + "\""; }

/// Integrators whose image is no radiance.
bool isLightTransport(const std::string& integrator) { return integrator != "ambientocclusion"; }
/// Integrators whose image is blurred by a radius: off by more than noise where light bounces.
bool isBlurred(const TinyView& view) { return view.integrator.starts_with("\"sppm\""); }
/// Integrators that choose where on the film a path goes: pixels are not exact one by one.
bool hasPathsEverywhere(const TinyView& view) { return view.integrator.starts_with("\"mlt\""); }
/// Integrators that stop at the first surface that is not specular.
bool isDirectOnly(const TinyView& view) {
  return view.integrator.starts_with("\"directlighting\"") ||
         view.integrator.starts_with("\"whitted\"");
}

/// Every integrator with every sampler.
std::vector<TinyView> allViews(const std::string& integratorParameters = "") {
  std::vector<TinyView> views;
  for (const auto& i : integratorRegistry().entries()) {
    if (!isLightTransport(i.name)) continue;
    for (const auto& s : samplerRegistry().entries()) {
      TinyView v;
      v.integrator = quoted(i.name) + integratorParameters;
      v.sampler = quoted(s.name);
      if (hasPathsEverywhere(v)) v.integrator += " \"integer bootstrapsamples\" 10000";
      views.push_back(v);
      if (hasPathsEverywhere(v)) break;  // takes nothing from the sampler
    }
  }
  return views;
}

/// Renders and compares the mean of the pixels.
void expectRadiance(const TinyView& view, const std::string& world, double expected,
                    double relativeSlack, uint64_t samples = 64) {
  TinyScene scene(tinyScene(view, world));
  scene.render(samples);
  EXPECT_EQ(meanTest(scene.greens(), expected, relativeSlack * expected), "")
      << view.integrator << " " << view.sampler << "\n"
      << world;
  EXPECT_EQ(scene.badSamples(), 0) << view.integrator << " " << view.sampler;
}

/// A sphere about the origin that emits 1 inwards.
std::string furnace(float albedo) {
  return matte(albedo) +
         "AreaLightSource \"diffuse\" \"rgb L\" [1 1 1]\n"
         "ReverseOrientation\nShape \"sphere\" \"float radius\" 2\n";
}
const std::string kInside = "0 0 0  0 0 1  0 1 0";
const std::string kWide = R"("perspective" "float fov" 90)";

TEST(Radiance, PointLightAbovePlane) {
  // ρ/π · I cos θ / d², light at the side so that cos θ = 4/5, d = 5.
  for (const TinyView& view : allViews())
    expectRadiance(view,
                   "LightSource \"point\" \"point from\" [3 0 4] \"rgb I\" [10 10 10]\n" +
                       matte(0.5f) + square(1),
                   0.5 / M_PI * 10 * 0.8 / 25, 2e-3, 4);
}

TEST(Radiance, DistantLightOnPlane) {
  for (const TinyView& view : allViews())
    expectRadiance(view,
                   "LightSource \"distant\" \"point from\" [3 0 4] \"point to\" [0 0 0] "
                   "\"rgb L\" [2 2 2]\n" +
                       matte(0.5f) + square(1),
                   0.5 / M_PI * 2 * 0.8, 1e-4, 4);
}

TEST(Radiance, SphereLightAbovePlane) {
  // Irradiance πL r² / d² of a sphere at the zenith.
  for (TinyView view : allViews()) {
    view.lookAt = "5 0 5  0 0 0  0 0 1";
    expectRadiance(
        view,
        matte(0.5f) + square(1) +
            "AttributeBegin\nTranslate 0 0 3\nAreaLightSource \"diffuse\" \"rgb L\" [7 7 7]\n"
            "Material \"matte\" \"rgb Kd\" [0 0 0]\nShape \"sphere\" \"float radius\" 0.5\n"
            "AttributeEnd\n",
        0.5 * 7 * 0.25 / 9, 2e-3);
  }
}

TEST(Radiance, ConstantEnvironmentOnPlane) {
  for (const TinyView& view : allViews())
    expectRadiance(view, "LightSource \"infinite\" \"rgb L\" [3 3 3]\n" + matte(0.5f) + square(1),
                   1.5, 1e-3);
}

TEST(Radiance, FurnaceOfManyBounces) {
  for (TinyView view : allViews(" \"integer maxdepth\" 30")) {
    if (isDirectOnly(view) || isBlurred(view) || hasPathsEverywhere(view)) continue;
    view.lookAt = kInside;
    view.camera = kWide;
    // Every pair of vertices is joined: few samples cost as much as many of others.
    const bool bidirectional = view.integrator.starts_with("\"bdpt\"");
    expectRadiance(view, furnace(0.5f), 2, 1e-3, bidirectional ? 4 : 64);
  }
}

TEST(Radiance, DepthCutsTheSeriesOfBounces) {
  for (const char* integrator : {"path", "pathtree"}) {
    double expected = 0;
    for (int depth = 0; depth < 4; ++depth) {
      expected += std::pow(0.5, depth);
      TinyView view;
      view.integrator = quoted(integrator) + " \"integer maxdepth\" " + std::to_string(depth);
      view.lookAt = kInside;
      view.camera = kWide;
      expectRadiance(view, furnace(0.5f), expected, 1e-3, 128);
    }
  }
}

TEST(Radiance, DirectLightingIsOneBounce) {
  for (const char* strategy : {"all", "one"}) {
    for (int depth = 0; depth < 3; ++depth) {
      TinyView view;
      view.integrator = "\"directlighting\" \"string strategy\" " + quoted(strategy) +
                        " \"integer maxdepth\" " + std::to_string(depth);
      view.lookAt = kInside;
      view.camera = kWide;
      expectRadiance(view, furnace(0.5f), 1.5, 1e-3, 128);
    }
  }
}

TEST(Radiance, MirrorsAndGlassShowAConstantEnvironmentUnchanged) {
  const std::string sky = "LightSource \"infinite\" \"rgb L\" [3 3 3]\n";
  for (TinyView view : allViews(" \"integer maxdepth\" 20")) {
    view.camera = R"("perspective" "float fov" 50)";
    expectRadiance(
        view, sky + "Material \"mirror\" \"rgb Kr\" [1 1 1]\nShape \"sphere\" \"float radius\" 2\n",
        3, 1e-4, 8);
    expectRadiance(view, sky + "Material \"glass\"\nShape \"sphere\" \"float radius\" 2\n", 3, 1e-3,
                   8);
  }
}

TEST(Radiance, DirectLightingFollowsBothBranchesOfGlass) {
  // A pane, light on the camera's side only: the sum of reflections from the front, 1 − T for T
  // the share that ends behind it. With one sample there is no noise if every branch is followed.
  TinyView view;
  view.integrator = R"("directlighting" "integer maxdepth" 12)";
  view.lookAt = "0 0 5  0 0 0  0 1 0";
  view.resolution = 2;
  const std::string world =
      "Material \"glass\" \"float eta\" 1.5\nShape \"sphere\" \"float radius\" 1\n"
      "AttributeBegin\nTranslate 0 0 -9\nMaterial \"matte\" \"rgb Kd\" [0 0 0]\n"
      "AreaLightSource \"diffuse\" \"rgb L\" [1 1 1]\n" +
      square(8) + "AttributeEnd\n";
  TinyScene scene(tinyScene(view, world));
  scene.render(1);
  // Straight through: (1 − R)² (1 + R² + …) = (1 − R) / (1 + R), R = 0.04.
  for (const double v : scene.greens()) EXPECT_NEAR(v, 0.96 / 1.04, 1e-4);
}

TEST(Radiance, EmittersOfOneAndTwoSides) {
  for (TinyView view : allViews()) {
    for (const bool behind : {false, true}) {
      for (const bool twoSided : {false, true}) {
        view.lookAt = behind ? "0 0 -5  0 0 0  0 1 0" : "0 0 5  0 0 0  0 1 0";
        TinyScene scene(tinyScene(
            view,
            std::string("AreaLightSource \"diffuse\" \"rgb L\" [3 3 3] \"bool twosided\" \"") +
                (twoSided ? "true" : "false") + "\"\n" + matte(0) + square(1)));
        const float expected = behind && !twoSided ? 0.f : 3.f;
        if (hasPathsEverywhere(view)) {
          scene.render(64);
          EXPECT_EQ(meanTest(scene.greens(), static_cast<double>(expected)), "");
          continue;
        }
        scene.render(1);
        for (const Rgb& c : scene.pixels()) EXPECT_EQ(c.g, expected) << view.integrator;
      }
    }
  }
}

TEST(Radiance, SceneWithoutLightsIsBlack) {
  for (const TinyView& view : allViews()) {
    TinyScene scene(tinyScene(view, matte(0.5f) + square(1)));
    scene.render(2);
    for (const Rgb& c : scene.pixels()) EXPECT_TRUE(c.isBlack());
    TinyScene empty(tinyScene(view, ""));
    empty.render(2);
    for (const Rgb& c : empty.pixels()) EXPECT_TRUE(c.isBlack());
  }
}

}  // namespace

}  // namespace lampyris::test
