// SPDX-License-Identifier: Apache-2.0
#include "integrators/guided_path.h"

#include <gtest/gtest.h>

#include "core/parallel.h"
#include "support/statistics.h"
#include "support/tiny_scenes.h"

namespace lampyris::test {

namespace {

/// A room lit through a gap, with matte, glossy, translucent and glass surfaces.
const std::string kRoom =
    "AttributeBegin\nAreaLightSource \"diffuse\" \"rgb L\" [40 40 40]\nTranslate 1.4 0 1.9\n"
    "Rotate 180 1 0 0\n" +
    square(0.3f) + "AttributeEnd\nAttributeBegin\n" + matte(0.6f) +
    "ReverseOrientation\nShape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3 4 6 5 4 7 6 0 4 5 "
    "0 5 1 1 5 6 1 6 2 2 6 7 2 7 3 3 7 4 3 4 0] \"point P\" [-2 -2 0 2 -2 0 2 2 0 -2 2 0 -2 -2 2 "
    "2 -2 2 2 2 2 -2 2 2]\nAttributeEnd\n"
    "AttributeBegin\nMaterial \"translucent\"\nTranslate 0.7 0 0.8\nRotate 80 0 1 0\n" +
    square(0.8f) +
    "AttributeEnd\nAttributeBegin\nMaterial \"plastic\" \"float roughness\" 0.1\nTranslate -0.6 "
    "-0.3 0.3\nShape \"sphere\" \"float radius\" 0.3\nAttributeEnd\n"
    "AttributeBegin\nMaterial \"glass\"\nTranslate 0 0.5 0.3\nShape \"sphere\" \"float radius\" "
    "0.3\nAttributeEnd\n";

const std::string kMist =
    "MakeNamedMedium \"mist\" \"string type\" \"homogeneous\" \"rgb sigma_a\" [0.05 0.05 0.05] "
    "\"rgb sigma_s\" [0.4 0.4 0.4] \"float g\" 0.3\nMediumInterface \"mist\" \"mist\"\n";

TinyView view(const std::string& integrator, int resolution = 24) {
  TinyView v;
  v.integrator = integrator;
  v.lookAt = "-1.7 -1.7 1.2  0 0 0.6  0 0 1";
  v.camera = R"("perspective" "float fov" 60)";
  v.resolution = resolution;
  return v;
}

std::vector<double> render(const std::string& integrator, const std::string& world, uint64_t seed,
                           uint64_t samples) {
  BuildOptions options;
  options.seed = seed;
  TinyScene scene(tinyScene(view(integrator), world), options);
  scene.render(samples);
  EXPECT_EQ(scene.badSamples(), 0);
  EXPECT_EQ(scene.warnings(), "");
  return scene.greens();
}

void expectSameMean(const std::string& a, const std::string& b, const std::string& world,
                    uint64_t samples) {
  std::vector<double> difference = render(a, world, 1, samples);
  const auto other = render(b, world, 77, samples);
  for (size_t i = 0; i < difference.size(); ++i) difference[i] -= other[i];
  EXPECT_EQ(meanTest(difference, 0), "") << a << " against " << b;
}

/// A lamp in a box that is open above: all light comes from a spot on the ceiling.
const std::string kUplight =
    matte(0.7f) +
    "ReverseOrientation\nShape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3 4 6 "
    "5 4 7 6 0 4 5 0 5 1 1 5 6 1 6 2 2 6 7 2 7 3 3 7 4 3 4 0] \"point P\" [-2 -2 0 2 "
    "-2 0 2 2 0 -2 2 0 -2 -2 2 2 -2 2 2 2 2 -2 2 2]\nReverseOrientation\nTranslate "
    "1 1 1.5\nShape \"cylinder\" \"float radius\" 0.25 \"float zmin\" -0.1 "
    "\"float zmax\" 0.35\nAreaLightSource \"diffuse\" \"rgb L\" [40 40 40]\n" +
    square(0.15f);

TEST(GuidedPath, HasTheMeanOfVolpath) {
  const std::string volpath = R"("volpath" "integer maxdepth" 6)";
  for (const std::string& world : {kRoom, kMist + kRoom}) {
    expectSameMean(R"("guidedpath" "integer maxdepth" 6)", volpath, world, 64);
    expectSameMean(R"("guidedpath" "integer maxdepth" 6 "float bsdffraction" 0.1)", volpath, world,
                   64);
  }
  expectSameMean(R"("guidedpath" "integer maxdepth" 6 "integer ncache" 1 "float radius" 0.5)",
                 volpath, kRoom, 64);
  expectSameMean(
      R"("guidedpath" "integer maxdepth" 6 "string guide" "photons" "integer photons" 3000)",
      volpath, kRoom, 32);
}

TEST(GuidedPath, HasTheMeanWhereLightIsTriedRarely) {
  expectSameMean(R"("guidedpath" "integer maxdepth" 6)", R"("volpath" "integer maxdepth" 6)",
                 kUplight, 256);
}

TEST(GuidedPath, WithoutAGuideItIsVolpath) {
  const auto a = render(R"("guidedpath" "string guide" "none")", kMist + kRoom, 3, 4);
  EXPECT_EQ(a, render(R"("volpath")", kMist + kRoom, 3, 4));
}

TEST(GuidedPath, ImageDoesNotDependOnThreads) {
  std::string first;
  for (const int threads : {1, 4, 3}) {
    const ThreadLimit limit(threads);
    TinyScene scene(tinyScene(view(R"("guidedpath")", 33), kMist + kRoom));
    scene.render(16);
    if (first.empty()) first = scene.film().save();
    EXPECT_TRUE(scene.film().save() == first) << threads << " threads";
    EXPECT_GT(scene.statistics().value("guide", "records"), 0);
  }
}

TEST(GuidedPath, GuidesWhereLightIsHardToFindAndKnowsIt) {
  // Variance over seeds, pixel by pixel.
  const auto variance = [&](const std::string& integrator) {
    double sum = 0;
    for (uint64_t seed = 1; seed < 13; seed += 2) {
      const auto a = render(integrator, kUplight, seed, 64),
                 b = render(integrator, kUplight, seed + 1, 64);
      for (size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
    }
    return sum;
  };
  const double ratio = variance(R"("guidedpath")") / variance(R"("volpath")");
  EXPECT_LT(ratio, 0.9);
  TinyScene scene(tinyScene(view(R"("guidedpath")"), kUplight));
  scene.render(64);
  EXPECT_NEAR(scene.statistics().value("guide", "variance with the guide over that without"), ratio,
              0.3 * ratio);
  EXPECT_EQ(scene.statistics().value("guide", "retired"), 0);
}

TEST(GuidedPath, GuidesOnlyWhereThereIsLightToSee) {
  // What a black floor scatters, nobody sees.
  const auto shareGuided = [](float albedo) {
    const std::string floor =
        "AttributeBegin\nTranslate 0 0 0.01\n" + matte(albedo) + square(2) + "AttributeEnd\n";
    TinyScene scene(tinyScene(view(R"("guidedpath")"), floor + kUplight));
    scene.render(32);
    return scene.statistics().value("guide", "share of directions with a guide");
  };
  const double grey = shareGuided(0.7f);
  EXPECT_GT(grey, 0.8);
  EXPECT_LT(shareGuided(1e-3f), 0.8 * grey);
}

TEST(GuidedPath, RetiresWhereItDoesNotPay) {
  // Open and diffuse: light sampling and the BSDF find nearly all that there is to find.
  const std::string open =
      "LightSource \"infinite\" \"rgb L\" [.3 .35 .4]\nAttributeBegin\nAreaLightSource \"diffuse\" "
      "\"rgb L\" [20 20 20]\nTranslate 2 -2 5\nReverseOrientation\nShape \"disk\" \"float radius\" "
      "0.7\nAttributeEnd\n" +
      matte(0.5f) + square(20) +
      "AttributeBegin\nTranslate -1 0 0.7\nShape \"sphere\" \"float radius\" 0.7\nAttributeEnd\n";
  TinyView above = view(R"("guidedpath" "integer maxdepth" 5)", 40);
  above.lookAt = "0 -6 3  0 0 0.5  0 0 1";
  TinyScene bright(tinyScene(above, open));
  bright.render(128);
  EXPECT_EQ(bright.statistics().value("guide", "retired"), 1);
  EXPECT_LT(bright.statistics().value("guide", "share of directions with a guide"), 0.06)
      << "photons have told enough after 4 of 128 samples";
  TinyScene room(tinyScene(view(R"("guidedpath")"), kRoom));
  room.render(128);
  EXPECT_EQ(room.statistics().value("guide", "retired"), 1);
}

TEST(GuidedPath, MemoryIsBounded) {
  TinyScene scene(tinyScene(view(R"("guidedpath" "integer maxrecords" 50)"), kRoom));
  scene.render(32);
  EXPECT_LE(scene.statistics().value("guide", "records"), 50);
  EXPECT_GT(scene.statistics().value("guide", "records"), 5);
  TinyScene none(tinyScene(view(R"("guidedpath" "integer maxrecords" 0)"), kRoom));
  none.render(8);
  EXPECT_EQ(none.statistics().value("guide", "records"), 0);
}

TEST(GuidedPath, LearnsAsMuchFromEveryPassOfALargeImage) {
  const auto learned = [](uint64_t samples) {
    TinyScene scene(tinyScene(view(R"("guidedpath" "integer maxdepth" 4)", 400), kUplight));
    scene.render(samples);
    return scene.statistics().value("guide", "samples learned from");
  };
  double before = learned(1);
  EXPECT_EQ(before, 0) << "nobody asks what the last pass has found";
  for (const uint64_t samples : {2, 4, 8}) {  // a pass more each
    const double all = learned(samples);
    EXPECT_LT(all - before, 1.1 * GuideTrainer::kSamplesPerPass) << samples;
    EXPECT_GT(all - before, 0.2 * GuideTrainer::kSamplesPerPass) << samples;
    before = all;
  }
}

TEST(GuidedPath, ScaleDoesNotMatter) {
  for (const std::string s : {"1e-4", "1e4"}) {
    TinyScene scene(tinyScene(
        [&] {
          TinyView v = view(R"("guidedpath")");
          v.lookAt = "-1.7 -1.7 1.2  0 0 0.6  0 0 1\nScale 1 1 1";
          return v;
        }(),
        "Scale " + s + " " + s + " " + s + "\n" + kRoom));
    EXPECT_NO_THROW(scene.render(8));
    EXPECT_EQ(scene.badSamples(), 0);
  }
}

TEST(GuidedPath, SceneOfOnePointAndEmptyScenes) {
  for (const std::string& world :
       {std::string("LightSource \"infinite\"\n"), std::string("LightSource \"point\"\n"),
        kMist + "LightSource \"infinite\"\n", std::string()}) {
    TinyScene scene(tinyScene(view(R"("guidedpath")", 4), world));
    scene.render(16);
    EXPECT_EQ(scene.badSamples(), 0);
  }
}

/// Each part of a render learns from its own samples, beginning with none.
TEST(GuidedPath, PartsThatLearnApartHaveTheMeanOfVolpath) {
  constexpr uint64_t kParts = 4, kEach = 16;
  auto difference = render(R"("volpath")", kRoom, 77, kParts * kEach);
  const std::string text = tinyScene(view(R"("guidedpath")"), kRoom);
  for (double& d : difference) d = -d;
  for (uint64_t part = 0; part < kParts; ++part) {
    TinyScene scene(text);
    RenderOptions options;
    options.firstIndex = part * kEach;
    options.sampleCount = kEach;
    EXPECT_EQ(scene.render(options), kEach);
    EXPECT_EQ(scene.statistics().value("guide", "passes"), 5);  // of 1, 1, 2, 4 and 8 samples
    EXPECT_GT(scene.statistics().value("guide", "share of directions with a guide"), 0.1);
    const auto greens = scene.greens();
    for (size_t i = 0; i < greens.size(); ++i) difference[i] += greens[i] / kParts;
  }
  EXPECT_EQ(meanTest(difference, 0), "");
}

TEST(GuidedPath, GoesOnFromWhatItHasLearned) {
  const std::string text = tinyScene(view(R"("guidedpath")", 24), kMist + kRoom);
  TinyScene whole(text), resumed(text);
  RenderOptions options;
  options.sampleCount = 23;
  std::string film;
  RenderOptions rest = options;
  options.onPass = [&](const RenderProgress& p) {
    ASSERT_NE(p.learned, nullptr);
    if (p.samplesDone != 8) return;
    film = whole.film().save();
    rest.firstSample = p.samplesDone;
    rest.learned = p.learned->save();
  };
  whole.render(options);
  ASSERT_EQ(rest.firstSample, 8u);
  ASSERT_TRUE(resumed.film().restore(film));
  resumed.render(rest);
  EXPECT_TRUE(whole.film().save() == resumed.film().save());

  // With nothing learned, or part of it, it would go another way.
  for (const size_t kept : {size_t{0}, size_t{5}, rest.learned.size() - 1}) {
    RenderOptions broken = rest;
    broken.learned.resize(kept);
    EXPECT_THROW(TinyScene(text).render(broken), SceneError);
  }
}

}  // namespace

}  // namespace lampyris::test
