// SPDX-License-Identifier: Apache-2.0
// Adaptive direct lighting against brute force, pixel by pixel, where BSDF samples seldom hit and
// its allocation swings.
#include <gtest/gtest.h>

#include "support/statistics.h"
#include "support/tiny_scenes.h"

namespace lampyris::test {

namespace {

std::string emitter(float x, float y, float z, float radius, float radiance) {
  const std::string l = std::to_string(radiance);
  return "AttributeBegin\nAreaLightSource \"diffuse\" \"rgb L\" [" + l + " " + l + " " + l +
         "]\nTranslate " + std::to_string(x) + " " + std::to_string(y) + " " + std::to_string(z) +
         "\nShape \"sphere\" \"float radius\" " + std::to_string(radius) + "\nAttributeEnd\n";
}

/// Lacquer, brushed metal and rough glass under small lamps, a large panel and a point light; a
/// screen casts shadows.
std::string hurtfulScene(const std::string& extra = "") {
  std::string s = extra + matte(0.4f);
  for (uint32_t i = 0; i < 24; ++i)
    s += emitter(4 * uniform(8, i, 0) - 2, 3 + 2 * uniform(8, i, 1), 0.3f + 2 * uniform(8, i, 2),
                 0.02f + 0.03f * uniform(8, i, 3), 30 + 300 * uniform(8, i, 4));
  s += "AttributeBegin\nTranslate 0.8 2.5 1.5\nRotate 100 1 0 0\nAreaLightSource \"diffuse\" "
       "\"rgb L\" [2 2 2]\n" +
       square(0.4f) + "AttributeEnd\n";
  s += "LightSource \"point\" \"point from\" [-1 1 1] \"rgb I\" [0.5 0.5 0.5]\n";
  s +=
      "AttributeBegin\nTranslate -0.6 1.5 0.4\nRotate 90 1 0 0\n" + square(0.2f) + "AttributeEnd\n";
  s += "Material \"plastic\" \"rgb Kd\" [0.1 0.1 0.1] \"rgb Ks\" [0.6 0.6 0.6] \"float roughness\" "
       "0.03 \"bool remaproughness\" \"false\"\n" +
       square(3);
  s += "Material \"metal\" \"float roughness\" 0.2\n"
       "AttributeBegin\nTranslate -0.4 0 0.3\nShape \"sphere\" \"float radius\" 0.3\nAttributeEnd\n"
       "Material \"glass\" \"float uroughness\" 0.2 \"float vroughness\" 0.1\n"
       "AttributeBegin\nTranslate 0.4 -0.2 0.25\nShape \"sphere\" \"float radius\" 0.25\n"
       "AttributeEnd\n";
  return s;
}

std::vector<std::vector<double>> runs(const std::string& integrator, const std::string& world,
                                      uint64_t samples, uint64_t firstSeed, int count) {
  TinyView view;
  view.integrator = integrator;
  view.sampler = R"("random")";
  view.lookAt = "0 -2 0.9  0 0.2 0.2  0 0 1";
  view.camera = R"("perspective" "float fov" 50)";
  view.resolution = 5;
  std::vector<std::vector<double>> all;
  for (int i = 0; i < count; ++i) {
    BuildOptions options;
    options.seed = firstSeed + static_cast<uint64_t>(i);
    TinyScene scene(tinyScene(view, world), options);
    scene.render(samples);
    EXPECT_EQ(scene.badSamples(), 0);
    EXPECT_EQ(scene.warnings(), "");
    all.push_back(scene.greens());
  }
  return all;
}

/// Every pixel's mean over many runs is that of brute force, within the standard error of their
/// difference (false alarms: 1e-9 a pixel) and 0.2 %.
void expectEqual(const std::string& mine, const std::string& reference, const std::string& world,
                 uint64_t samples, uint64_t referenceSamples, double slack = 2e-3) {
  constexpr int kRuns = 160;
  const auto a = runs(mine, world, samples, 1, kRuns);
  const auto b = runs(reference, world, referenceSamples, 1000, kRuns);
  for (size_t pixel = 0; pixel < a[0].size(); ++pixel) {
    std::vector<double> differences;
    double sum = 0;
    for (size_t i = 0; i < kRuns; ++i) {
      differences.push_back(a[i][pixel] - b[i][pixel]);
      sum += b[i][pixel];
    }
    EXPECT_EQ(meanTest(differences, 0, slack * sum / kRuns), "") << mine << ", pixel " << pixel;
  }
}

std::string direct(const std::string& parameters) {
  return "\"directlighting\" \"string strategy\" \"adaptive\" \"string lightsampler\" \"brdf\" " +
         parameters;
}
const std::string kBruteForce = R"("directlighting" "string strategy" "all")";

TEST(AdaptiveDirect, IsUnbiasedForAnyThresholdAndCount) {
  for (const char* count : {"1", "7", "50"})
    for (const char* threshold : {"0.005", "0.5", "0.7"})
      expectEqual(direct(std::string("\"integer maxbrdfsamples\" ") + count +
                         " \"float cutthreshold\" " + threshold),
                  kBruteForce, hurtfulScene(), 6, 2);
}

TEST(AdaptiveDirect, IsUnbiasedForAnyAllocation) {
  for (const char* allocation : {"equal", "lights", "bsdf"})
    expectEqual(direct(std::string("\"string brdfallocation\" \"") + allocation + "\""),
                kBruteForce, hurtfulScene(), 6, 2);
}

TEST(AdaptiveDirect, IsUnbiasedUnderASky) {
  const std::string sky =
      "LightSource \"infinite\" \"rgb L\" [0.3 0.3 0.3]\n"
      "LightSource \"distant\" \"point from\" [1 1 2] \"rgb L\" [0.5 0.5 0.5]\n";
  expectEqual(direct("\"integer maxbrdfsamples\" 9"), kBruteForce, hurtfulScene(sky), 6, 2);
}

TEST(AdaptiveDirect, IsUnbiasedInPaths) {
  const std::string path = R"("path" "integer maxdepth" )";
  const std::string adaptive =
      R"( "string strategy" "adaptive" "string lightsampler" "brdf" "integer adaptivevertices" )";
  for (const char* vertices : {"0", "1", "3"}) {
    expectEqual(path + "1" + adaptive + vertices, kBruteForce, hurtfulScene(), 6, 2);
    expectEqual(path + "3" + adaptive + vertices, path + "3", hurtfulScene(), 12, 24);
  }
}

/// One point of a rough metal that sees a panel of small lamps in its lobe: BSDF samples hit a few
/// times in a hundred, so that the shares drift all the way, at tens of samples a point.
TEST(AdaptiveDirect, IsUnbiasedWhereSharesDrift) {
  std::string world =
      "Material \"metal\" \"float roughness\" 0.25 \"bool remaproughness\" "
      "\"false\"\n" +
      square(1) + matte(0);
  for (uint32_t i = 0; i < 30; ++i)
    world += emitter(2 * uniform(5, i, 0) - 1, 2 + 2 * uniform(5, i, 1), 1 + 2 * uniform(5, i, 2),
                     0.04f, 10 + 90 * uniform(5, i, 3));
  TinyView view;
  view.lookAt = "0 -3 2  0 0 0  0 0 1";
  view.resolution = 16;
  const auto render = [&](const std::string& integrator, uint64_t samples) {
    view.integrator = integrator;
    auto scene = std::make_unique<TinyScene>(tinyScene(view, world));
    scene->render(samples);
    return scene;
  };
  const auto reference = render(kBruteForce, 64)->greens();
  for (const char* threshold : {"0.1", "1"}) {
    const auto scene = render(direct(std::string("\"float cutthreshold\" ") + threshold), 64);
    std::vector<double> difference = scene->greens();
    double mean = 0;
    for (size_t i = 0; i < difference.size(); ++i) {
      difference[i] -= reference[i];
      mean += reference[i] / static_cast<double>(reference.size());
    }
    EXPECT_EQ(meanTest(difference, 0, 1e-4 * mean), "");
  }
}

TEST(AdaptiveDirect, ReportsItsShares) {
  TinyView view;
  view.integrator = direct("");
  view.lookAt = "0 -2 0.9  0 0.2 0.2  0 0 1";
  view.camera = R"("perspective" "float fov" 50)";
  TinyScene scene(tinyScene(view, hurtfulScene()));
  scene.render(4);
  const auto value = [&](const char* name) {
    return scene.statistics().value("direct lighting", name);
  };
  EXPECT_GT(value("share of glossy points"), 0.9);
  EXPECT_GE(value("light tree samples a point"), 0.5);
  EXPECT_GE(value("BRDF-oriented clusters a glossy point"), 1);
  EXPECT_GT(value("BRDF-aware samples a glossy point"), 0);
  EXPECT_LE(value("BRDF-aware samples a glossy point"), 50);
  EXPECT_GT(value("share of BSDF samples"), 0);
  EXPECT_LT(value("share of BSDF samples"), 1);
  EXPECT_LT(value("share of BSDF samples that find light"), 1);
  double time = 0;
  for (const char* technique : {"light tree", "BRDF-oriented", "BSDF"}) {
    const double share = value((std::string("share of time, ") + technique).c_str());
    EXPECT_GT(share, 0) << technique;
    time += share;
  }
  EXPECT_NEAR(time, 1, 1e-9);
}

TEST(AdaptiveDirect, DiffusePointsTakeOneBsdfSample) {
  TinyView view;
  view.integrator = direct("");
  TinyScene scene(tinyScene(view, matte(0.5f) + square(1) + emitter(0, 0, 3, 0.1f, 5)));
  scene.render(2);
  EXPECT_EQ(scene.statistics().value("direct lighting", "share of glossy points"), 0);
  EXPECT_EQ(scene.statistics().value("direct lighting", "BRDF-aware samples a glossy point"), 0);
}

TEST(AdaptiveDirect, NeedsItsLightSampler) {
  TinyView view;
  view.integrator = R"("path" "string strategy" "adaptive" "string lightsampler" "power")";
  EXPECT_THROW(TinyScene(tinyScene(view, hurtfulScene())), SceneError);
  view.integrator = R"("path" "string strategy" "adaptive")";
  TinyScene scene(tinyScene(view, hurtfulScene()));
  EXPECT_EQ(scene.render(1), 1u);
}

TEST(AdaptiveDirect, ScenesWithoutLightsAreBlack) {
  TinyView view;
  view.integrator = direct("");
  TinyScene scene(tinyScene(view, "Material \"metal\"\n" + square(1)));
  scene.render(1);
  for (const Rgb& c : scene.pixels()) EXPECT_TRUE(c.isBlack());
}

}  // namespace

}  // namespace lampyris::test
