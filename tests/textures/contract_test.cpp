// SPDX-License-Identifier: Apache-2.0
// What every registered texture promises, with its defaults.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>

#include "support/statistics.h"
#include "textures/texture_test_support.h"

namespace lampyris {
namespace {

using namespace test;

/// With a picture for those that need one.
class EveryTexture : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    bench_.folder = std::filesystem::temp_directory_path().string();
    picture_ = "lampyris-texture-" + std::to_string(::getpid()) + ".pfm";
    Image grey(8, 8, 3);
    for (int y = 0; y < 8; ++y)
      for (int x = 0; x < 8; ++x) grey.setRgb(x, y, Rgb(static_cast<float>(x * y) / 49));
    writeImageFile(bench_.folder + "/" + picture_, grey);
    if (GetParam() == "imagemap") parameters_.word("filename", picture_);
  }
  void TearDown() override { std::filesystem::remove(bench_.folder + "/" + picture_); }

  /// Points near and far, with footprints from none to larger than the texture.
  static SurfaceInteraction point(uint64_t i) {
    const float scale = i % 5 == 0 ? 1e5f : 5.f,
                footprint = std::pow(10.f, static_cast<float>(i % 7) - 3);
    SurfaceInteraction s;
    s.p = scale * (Vec3(uniform(41, i, 0), uniform(41, i, 1), uniform(41, i, 2)) - 0.5f);
    s.uv = scale * (Vec2(uniform(41, i, 3), uniform(41, i, 4)) - 0.5f);
    if (i % 3 == 0) return s;
    s.dpdx = {footprint, 0, 0};
    s.dpdy = {0, footprint, 0};
    s.duvdx = {footprint, 0};
    s.duvdy = {0, footprint};
    return s;
  }

  TextureBench bench_;
  Parameters parameters_;
  std::string picture_;
};

TEST_P(EveryTexture, ValuesAreFiniteAndPure) {
  const auto spectrum = bench_.makeSpectrum(GetParam(), parameters_);
  const auto again = bench_.makeSpectrum(GetParam(), parameters_);
  for (uint64_t i = 0; i < 2000; ++i) {
    const Rgb c = spectrum->evaluate(point(i));
    ASSERT_TRUE(c.isFinite()) << i;
    EXPECT_EQ(c, again->evaluate(point(i))) << i;
  }
}

TEST_P(EveryTexture, NumbersAndColoursAgree) {
  if (!floatTextureRegistry().find(GetParam())) {
    // In pbrt-v3 there are colours of these alone.
    EXPECT_TRUE(GetParam() == "uv" || GetParam() == "marble");
    return;
  }
  const auto spectrum = bench_.makeSpectrum(GetParam(), parameters_);
  const auto number = bench_.makeFloat(GetParam(), parameters_);
  for (uint64_t i = 0; i < 2000; ++i) {
    if (i % 5 == 0) continue;  // far away, "bilerp" is all rounding
    const Rgb c = spectrum->evaluate(point(i));
    EXPECT_NEAR(number->evaluate(point(i)), c.g, 1e-5f * (1 + std::abs(c.g))) << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Textures, EveryTexture,
                         testing::ValuesIn(spectrumTextureRegistry().names()),
                         [](const auto& test) { return test.param; });

TEST(Textures, NumbersAreThereAsColoursToo) {
  for (const std::string& name : floatTextureRegistry().names())
    EXPECT_TRUE(spectrumTextureRegistry().find(name)) << name;
}

}  // namespace
}  // namespace lampyris
