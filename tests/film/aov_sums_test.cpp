// SPDX-License-Identifier: Apache-2.0
#include "film/aov_sums.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

namespace lampyris {
namespace {

AovSet all() {
  AovSet set;
  for (size_t i = 0; i < kAovNames.size(); ++i) set.add(static_cast<Aov>(i));
  return set;
}

std::map<std::string, std::vector<float>> byName(const std::vector<ImageLayer>& layers) {
  std::map<std::string, std::vector<float>> map;
  for (const ImageLayer& l : layers) map[l.name] = l.values;
  return map;
}

/// A path that hits a surface at distance 2 and draws two lights there.
AovRecord hitRecord() {
  AovRecord r;
  r.cameraPoint = {0, 0, 1};
  r.surface({0, 0, 3}, {0, 1, 0}, Rgb(0.1f, 0.2f, 0.3f));
  r.beginLightVertex();
  r.lightDraw(0.25f);
  r.lightDraw(0.5f);
  r.lightDraw(0);  // no draw
  r.lightSampled(Rgb(3));
  r.bsdfSampled(Rgb(1));
  r.brdfAware(8, 6);
  r.segments = 3;
  r.seconds = 2e-6;
  // What comes from later vertices does not count.
  r.beginLightVertex();
  r.lightDraw(0.001f);
  r.lightSampled(Rgb(100));
  r.bsdfSampled(Rgb(100));
  r.brdfAware(100, 1);
  return r;
}

TEST(AovSums, MeansByHand) {
  AovSums sums(all(), 2);
  AovRecord miss;
  miss.segments = 1;
  sums.add(0, hitRecord());
  sums.add(0, miss);
  sums.addColour(0, {1, 2, 4});
  sums.addColour(0, {3, 2, 0});
  const std::vector<PixelSums> pixels{{{4}, {4}, {4}, 0, 2}, {}};
  auto layers = byName(sums.layers(pixels, 10));
  EXPECT_EQ(layers.size(), 18u);
  EXPECT_FLOAT_EQ(layers["albedo.G"][0], 0.1f);
  EXPECT_FLOAT_EQ(layers["N.Y"][0], 0.5f);
  EXPECT_FLOAT_EQ(layers["depth.Z"][0], 2);  // of the paths that hit something
  EXPECT_EQ(layers["samplecount.Y"][0], 2);
  // Means 2 2 2, variances of the mean 1 0 4, scaled by 10².
  EXPECT_FLOAT_EQ(layers["variance.R"][0], 100);
  EXPECT_FLOAT_EQ(layers["variance.G"][0], 0);
  EXPECT_FLOAT_EQ(layers["variance.B"][0], 400);
  EXPECT_EQ(layers["lightcut.Y"][0], 2);
  EXPECT_FLOAT_EQ(layers["bsdfshare.Y"][0], 0.25f);
  EXPECT_EQ(layers["brdfsamples.Y"][0], 8);
  EXPECT_FLOAT_EQ(layers["bsdfdraws.Y"][0], 0.75f);
  EXPECT_FLOAT_EQ(layers["lightentropy.Y"][0], 1.5f);  // (2 + 1) / 2 bits
  EXPECT_EQ(layers["pathlength.Y"][0], 2);
  EXPECT_FLOAT_EQ(layers["time.Y"][0], 1);
  for (const auto& [name, values] : layers) EXPECT_EQ(values[1], 0) << name;
}

TEST(AovSums, KeepsOnlyWhatIsAskedFor) {
  AovSet set;
  set.add(Aov::Depth);
  set.add(Aov::PathLength);
  EXPECT_EQ(AovSums::sumsPerPixel(set), 3u);
  EXPECT_EQ(AovSums::sumsPerPixel({}), 0u);
  AovSums sums(set, 1);
  sums.add(0, hitRecord());
  sums.addColour(0, {1, 1, 1});
  const std::vector<PixelSums> pixels{{{}, {}, {}, 0, 1}};
  auto layers = byName(sums.layers(pixels, 1));
  ASSERT_EQ(layers.size(), 2u);
  EXPECT_EQ(layers["depth.Z"][0], 2);
  EXPECT_EQ(layers["pathlength.Y"][0], 3);
}

TEST(AovSums, ValuesThatAreNoNumbersAreLeftOut) {
  AovSums sums(all(), 1);
  AovRecord r = hitRecord();
  r.albedo = Rgb(std::nanf(""));
  r.depth = INFINITY;
  sums.add(0, r);
  const std::vector<PixelSums> pixels{{{1e300}, {}, {}, 0, 1}};
  for (const ImageLayer& l : sums.layers(pixels, 1e30))
    EXPECT_TRUE(std::isfinite(l.values[0])) << l.name;
}

}  // namespace
}  // namespace lampyris
