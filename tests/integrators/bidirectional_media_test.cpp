// SPDX-License-Identifier: Apache-2.0
// Participating media in paths that are made from both ends: closed forms, and "volpath".
#include "core/parallel.h"
#include "integrator_comparison.h"

namespace lampyris::test {

namespace {

std::vector<std::string> bidirectional(int depth) { return {withDepth("bdpt", depth), mlt(depth)}; }

std::string homogeneous(const std::string& absorption, const std::string& scattering,
                        const std::string& more = "") {
  return "MakeNamedMedium \"m\" \"string type\" \"homogeneous\" \"rgb sigma_a\" [" + absorption +
         "] \"rgb sigma_s\" [" + scattering + "] " + more + "\n";
}
/// From the floor of room() to its ceiling; colours differ.
const std::string kCloud =
    "MakeNamedMedium \"m\" \"string type\" \"heterogeneous\" \"rgb sigma_a\" [1 0.5 2] \"rgb "
    "sigma_s\" [4 3 2] \"float g\" 0.3 \"integer nx\" 2 \"integer ny\" 2 \"integer nz\" 2 \"point "
    "p0\" [-1 -1 0] \"point p1\" [1 1 1.8] \"float density\" [0.1 0.9 0.5 0 0.3 0.7 0 1]\n";
const std::string kFog = homogeneous("0.1 0.2 0.3", "0.5 0.4 0.3", "\"float g\" 0.5");
/// What stands at the world's end is around the camera.
const std::string kCameraWithin = "MediumInterface \"\" \"m\"\n";
const std::string kSky = "LightSource \"infinite\" \"rgb L\" [1 1 1]\n";

std::string ball(const std::string& place = "") {
  return "AttributeBegin\nMediumInterface \"m\" \"\"\nMaterial \"\"\n" + place +
         "Shape \"sphere\"\nAttributeEnd\n";
}

/// The means of images with different seeds.
std::vector<double> means(const TinyView& view, const std::string& world, uint64_t images,
                          uint64_t samples) {
  std::vector<double> all;
  for (uint64_t seed = 0; seed < images; ++seed) {
    BuildOptions options;
    options.seed = seed;
    TinyScene scene(tinyScene(view, world), options);
    EXPECT_EQ(scene.warnings(), "");
    scene.render(samples);
    EXPECT_EQ(scene.badSamples(), 0);
    double sum = 0;
    const auto greens = scene.greens();
    for (const double g : greens) sum += g / static_cast<double>(greens.size());
    all.push_back(sum);
  }
  return all;
}

TEST(BidirectionalMedia, AbsorptionFollowsBeersLaw) {
  TinyView view;
  for (const std::string& integrator : bidirectional(2)) {
    view.integrator = integrator;
    EXPECT_EQ(meanTest(means(view, homogeneous("0 0.7 0", "0 0 0") + ball() + kSky, 16, 16),
                       std::exp(-1.4), 1e-4),
              "")
        << integrator;
  }
}

TEST(BidirectionalMedia, SingleScatteringOfADistantLight) {
  // A slab −1 < z < 1, seen and lit from +z: light that is scattered at z has come 1 − z both ways.
  const std::string slab =
      "AttributeBegin\nMediumInterface \"m\" \"\"\nMaterial \"\"\nTranslate 0 0 1\n" + square(90) +
      "ReverseOrientation\nTranslate 0 0 -2\n" + square(90) + "AttributeEnd\n";
  TinyView view;
  view.camera = R"("perspective" "float fov" 1)";
  const std::string light =
      "LightSource \"distant\" \"rgb L\" [3 3 3] \"point from\" [0 0 1] \"point to\" [0 0 0]\n";
  const double expected = 3 * 0.5 / (4 * 3.14159265358979) * (1 - std::exp(-0.8 * 4)) / 1.6;
  for (const std::string& integrator : bidirectional(1)) {
    view.integrator = integrator;
    EXPECT_EQ(meanTest(means(view, homogeneous("0 0.3 0", "0 0.5 0") + slab + light, 16, 64),
                       expected, 1e-4),
              "")
        << integrator;
  }
}

TEST(BidirectionalMedia, FurnaceIsWhite) {
  TinyView view;
  for (const std::string g : {"0", "0.8"}) {
    view.integrator = withDepth("bdpt", 80);
    const std::string world = homogeneous("0 0 0", "2 2 2", "\"float g\" " + g) + ball() + kSky;
    EXPECT_EQ(meanTest(means(view, world, 16, 16), 1, 1e-4), "") << g;
  }
}

/// Both integrators against "volpath".
void expectVolpathsImage(const std::string& world, int depth, TinyView view = roomView("")) {
  TinyView reference = view;
  reference.integrator = withDepth("volpath", depth);
  view.integrator = withDepth("bdpt", depth);
  expectSameMean(view, reference, world, 48, 128);
  view.integrator = mlt(depth);
  view.resolution = reference.resolution = 8;
  expectSameImage(tinyScene(view, world), tinyScene(reference, world), 40, 64);
}

TEST(BidirectionalMedia, EqualVolpathAtEveryDepth) {
  for (const int depth : {0, 1, 2, 5}) expectVolpathsImage(kFog + room() + kCameraWithin, depth);
}

TEST(BidirectionalMedia, EqualVolpathForEveryLight) {
  // Each light alone, around a ball of fog on a floor and within it.
  const std::string floor = kFog + matte(0.6f) + square(2) + ball("Translate 0 0 1.1\n");
  for (const char* light :
       {R"("point" "point from" [0.3 0 1])", R"("point" "point from" [0.3 -1 2.5])",
        R"("spot" "point from" [0 0 2.5] "point to" [0 0 0])",
        R"("distant" "point from" [1 0 2] "point to" [0 0 0])", R"("infinite")"})
    expectVolpathsImage(std::string("LightSource ") + light + "\n" + floor, 3);
  for (const char* place : {"0 0 1.6", "0.3 0 2.4"})
    expectVolpathsImage("AttributeBegin\nAreaLightSource \"diffuse\" \"rgb L\" [4 4 4]\n" +
                            std::string("Translate ") + place + "\nRotate 180 1 0 0\n" +
                            square(0.3f) + "AttributeEnd\n" + floor,
                        3);
}

TEST(BidirectionalMedia, EndlessFogSwallowsLightFromInfinity) {
  const std::string sky = kSky +
                          "LightSource \"distant\" \"point from\" [1 0 2] \"point to\" [0 0 0]\n" +
                          matte(0.6f) + square(2);
  for (const std::string& integrator : bidirectional(3)) {
    TinyScene scene(tinyScene(roomView(integrator), kFog + sky + kCameraWithin));
    scene.render(16);
    for (const double g : scene.greens()) EXPECT_EQ(g, 0);
  }
  // What lets a colour pass lets it pass from anywhere.
  expectVolpathsImage(homogeneous("0.5 0 0.5", "0 0 0") + sky + kCameraWithin, 3);
}

TEST(BidirectionalMedia, EqualVolpathInClouds) {
  expectVolpathsImage(kCloud + room() + kCameraWithin, 3);
  // Light that comes through interfaces, and the cloud between them.
  expectVolpathsImage(kCloud + room() + ball("Translate 0 0 1\nScale 1 1 0.9\n"), 4);
}

TEST(BidirectionalMedia, EqualVolpathBehindGlass) {
  // Fog around smooth glass; the emitter's surface bounds the fog too.
  expectVolpathsImage(
      homogeneous("0.5 0.2 0.1", "2 3 4", "\"float g\" -0.3") +
          "AttributeBegin\nAreaLightSource \"diffuse\" \"rgb L\" [9 9 9]\nMediumInterface \"\" "
          "\"m\"\nTranslate -0.4 0 1.4\nShape \"sphere\" \"float radius\" 0.2\nAttributeEnd\n" +
          matte(0.6f) + square(2) + ball("Translate 0 0 0.9\nScale 0.8 0.8 0.88\n") +
          "Material \"glass\"\nAttributeBegin\nMediumInterface \"\" \"m\"\nTranslate 0.3 0 0.6\n"
          "Shape \"sphere\" \"float radius\" 0.3\nAttributeEnd\n",
      5);
  // Rough glass that is filled with it.
  TinyView view;
  view.camera = R"("perspective" "float fov" 15)";
  expectVolpathsImage(homogeneous("0 0 0", "1 3 1") +
                          "LightSource \"point\" \"point from\" [2 0 4]\n" +
                          "Material \"glass\" \"float uroughness\" 0.5 \"float vroughness\" 0.5\n"
                          "MediumInterface \"m\" \"\"\nShape \"sphere\"\n",
                      3, view);
}

TEST(BidirectionalMedia, EqualVolpathForEveryCamera) {
  TinyView view = roomView("");
  for (const char* camera :
       {R"("perspective" "float fov" 60 "float lensradius" 0.1 "float focaldistance" 1.5)",
        R"("environment")"}) {
    view.camera = camera;
    expectVolpathsImage(kFog + room() + kCameraWithin, 3, view);
  }
}

TEST(BidirectionalMedia, ThreadsDoNotCount) {
  for (const std::string& integrator : bidirectional(3)) {
    const auto image = [&](int threads) {
      const ThreadLimit limit(threads);
      TinyScene scene(tinyScene(roomView(integrator), kCloud + room() + kCameraWithin));
      scene.render(4);
      return scene.film().save();
    };
    EXPECT_EQ(image(1), image(3)) << integrator;
  }
}

}  // namespace

}  // namespace lampyris::test
