// SPDX-License-Identifier: Apache-2.0
/// Integrators held against each other on a small room.
#pragma once

#include <gtest/gtest.h>

#include "support/statistics.h"
#include "support/tiny_scenes.h"

namespace lampyris::test {

/// A room with two emitters, a point light, matte and glossy surfaces.
inline std::string room() {
  return "LightSource \"point\" \"point from\" [0.5 0.5 1] \"rgb I\" [0.4 0.4 0.4]\n"
         "AttributeBegin\nAreaLightSource \"diffuse\" \"rgb L\" [4 4 4]\nTranslate -0.5 0.2 1.5\n"
         "Rotate 180 1 0 0\n" +
         square(0.3f) +
         "AttributeEnd\n"
         "AttributeBegin\nAreaLightSource \"diffuse\" \"rgb L\" [20 20 20]\nTranslate 0.6 -0.4 "
         "0.5\nShape \"sphere\" \"float radius\" 0.05\nAttributeEnd\n" +
         matte(0.7f) + square(2) + "AttributeBegin\nTranslate 0 0 2\n" + square(2) +
         "AttributeEnd\n"
         "Material \"plastic\" \"float roughness\" 0.1\n"
         "AttributeBegin\nTranslate -0.2 -0.3 0.3\nShape \"sphere\" \"float radius\" "
         "0.3\nAttributeEnd\n";
}

inline TinyView roomView(const std::string& integrator) {
  TinyView v;
  v.integrator = integrator;
  v.lookAt = "0 -1.8 1  0 0 0.6  0 0 1";
  v.camera = R"("perspective" "float fov" 60)";
  v.resolution = 16;
  return v;
}

inline std::string withDepth(const std::string& integrator, int depth) {
  return "\"" + integrator + "\" \"integer maxdepth\" " + std::to_string(depth);
}

/// A ball on a floor, and a light.
inline std::string ballUnder(const std::string& light) {
  return "LightSource " + light + "\n" + matte(0.6f) + square(2) +
         "AttributeBegin\nTranslate 0 0 0.4\nShape \"sphere\" \"float radius\" 0.3\n"
         "AttributeEnd\n";
}
inline const std::vector<std::string> kLightsAbove = {
    R"("spot" "point from" [0 0 1.5] "point to" [0 0 0])",
    R"("distant" "point from" [1 0 2] "point to" [0 0 0])", R"("infinite")"};

/// A lamp above balls of glass and of half a mirror.
inline std::string glassRoom() {
  return "AttributeBegin\nAreaLightSource \"diffuse\" \"rgb L\" [9 9 9]\nTranslate -0.5 0.2 1.9\n"
         "Rotate 180 1 0 0\n" +
         square(0.6f) + "AttributeEnd\n" + matte(0.6f) + square(2) +
         "Material \"glass\"\nAttributeBegin\nTranslate -0.4 0 0.35\nShape \"sphere\" \"float "
         "radius\" 0.3\nAttributeEnd\n"
         "Material \"uber\" \"rgb Kr\" [0.3 0.3 0.3]\n"
         "AttributeBegin\nTranslate 0.4 0 0.35\nShape \"sphere\" \"float radius\" 0.3\n"
         "AttributeEnd\n";
}

/// For roomView().
inline const std::vector<std::string> kCameras = {
    R"("perspective" "float fov" 60 "float lensradius" 0.1 "float focaldistance" 1.5)",
    R"("orthographic" "float screenwindow" [-0.8 0.8 -0.8 0.8])", R"("environment")"};

/// The pixels of two scenes, rendered with different seeds, differ by noise only.
inline void expectSameMean(const std::string& a, const std::string& b, uint64_t samples,
                           uint64_t otherSamples) {
  TinyScene one(a);
  BuildOptions otherSeed;
  otherSeed.seed = 77;
  TinyScene two(b, otherSeed);
  one.render(samples);
  two.render(otherSamples);
  EXPECT_EQ(one.badSamples() + two.badSamples(), 0);
  std::vector<double> difference = one.greens();
  const auto other = two.greens();
  double mean = 0;
  for (size_t i = 0; i < difference.size(); ++i) difference[i] -= other[i], mean += other[i];
  EXPECT_GT(mean, 0);
  EXPECT_EQ(meanTest(difference, 0), "") << a << "against\n" << b;
}
inline void expectSameMean(const TinyView& a, const TinyView& b, const std::string& world,
                           uint64_t samples, uint64_t otherSamples = 0) {
  expectSameMean(tinyScene(a, world), tinyScene(b, world), samples,
                 otherSamples > 0 ? otherSamples : samples);
}
inline void expectSameMean(const std::string& a, const std::string& b, const std::string& world,
                           uint64_t samples) {
  expectSameMean(roomView(a), roomView(b), world, samples);
}

/// Few mutations, so that what would be biased at the start of chains shows.
inline std::string mlt(int depth, const std::string& more = "") {
  return "\"mlt\" \"integer bootstrapsamples\" 500 \"integer chains\" 40 \"integer maxdepth\" " +
         std::to_string(depth) + more;
}

/// Means over the quarters of an image.
inline std::vector<double> quarters(const std::string& text, uint64_t seed, uint64_t samples) {
  BuildOptions options;
  options.seed = seed;
  TinyScene scene(text, options);
  scene.render(samples);
  EXPECT_EQ(scene.badSamples(), 0);
  const auto greens = scene.greens();
  const Int2 size = scene.film().bounds().size();
  std::vector<double> sums(4);
  for (int y = 0; y < size.y; ++y)
    for (int x = 0; x < size.x; ++x)
      sums[static_cast<size_t>((2 * y < size.y ? 0 : 2) + (2 * x < size.x ? 0 : 1))] +=
          greens[static_cast<size_t>(y * size.x + x)] * 4 / (size.x * size.y);
  return sums;
}

/// For images whose pixels depend on each other: means over independent images agree.
inline void expectSameImage(const std::string& text, const std::string& reference,
                            uint64_t samples = 16, uint64_t referenceSamples = 64) {
  constexpr uint64_t kImages = 24;
  std::vector<std::vector<double>> difference(4);
  double mean = 0;
  for (uint64_t i = 0; i < kImages; ++i) {
    const auto a = quarters(text, i, samples), b = quarters(reference, 500 + i, referenceSamples);
    for (size_t q = 0; q < 4; ++q) difference[q].push_back(a[q] - b[q]), mean += b[q];
  }
  EXPECT_GT(mean, 0);
  for (size_t q = 0; q < 4; ++q)
    EXPECT_EQ(meanTest(difference[q], 0), "") << "quarter " << q << " of\n" << text;
}

}  // namespace lampyris::test
