// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "core/image_test_files.h"
#include "textures/texture_test_support.h"

namespace lampyris {
namespace {

using namespace test;

class ImagemapTest : public testing::Test {
 protected:
  ImagemapTest() { bench.folder = folder.path(); }
  static Parameters file(const std::string& name) {
    Parameters p;
    p.word("filename", name);
    return p;
  }
  std::string errorOf(const Parameters& p) {
    try {
      bench.makeSpectrum("imagemap", p);
    } catch (const SceneError& e) {
      EXPECT_EQ(e.location.file, 1u);
      return e.what();
    }
    return "";
  }
  TemporaryFolder folder;
  TextureBench bench;
};

TEST_F(ImagemapTest, TheBottomRowIsAtZero) {
  Image image(2, 2, 3);
  image.setRgb(0, 0, Rgb(1, 0, 0));  // top left
  image.setRgb(1, 0, Rgb(0, 1, 0));
  image.setRgb(0, 1, Rgb(0, 0, 1));  // bottom left
  writeImageFile(folder / "a.exr", image);
  const auto t = bench.makeSpectrum("imagemap", file("a.exr"));
  EXPECT_EQ(t->evaluate(atUv(0.25f, 0.25f)), Rgb(0, 0, 1));
  EXPECT_EQ(t->evaluate(atUv(0.75f, 0.25f)), Rgb(0));
  EXPECT_EQ(t->evaluate(atUv(0.25f, 0.75f)), Rgb(1, 0, 0));
  EXPECT_EQ(t->evaluate(atUv(1.75f, -0.25f)), Rgb(0, 1, 0));
}

TEST_F(ImagemapTest, WrapsBeyondTheImage) {
  Image image(2, 1, 1);
  image.at(0, 0, 0) = 1;
  image.at(1, 0, 0) = 3;
  writeImageFile(folder / "a.pfm", image);
  const auto at = [&](const char* wrap) {
    return bench.makeFloat("imagemap", file("a.pfm").word("wrap", wrap))
        ->evaluate(atUv(1.25f, 0.5f));
  };
  EXPECT_FLOAT_EQ(at("repeat"), 1);
  EXPECT_FLOAT_EQ(at("clamp"), 3);
  EXPECT_FLOAT_EQ(at("black"), 0);
}

TEST_F(ImagemapTest, GammaByEndingAndByParameter) {
  const Image image = [] {
    Image i(1, 1, 3);
    i.setRgb(0, 0, Rgb(0.2f, 0.5f, 0.8f));
    return i;
  }();
  for (const char* name : {"a.png", "a.tga", "a.bmp", "a.exr"}) {
    writeImageFile(folder / name, image);
    const Rgb c = bench.makeSpectrum("imagemap", file(name))->evaluate(atUv(0, 0));
    EXPECT_NEAR(c.r, 0.2f, 0.005) << name;
    EXPECT_NEAR(c.b, 0.8f, 0.005) << name;
  }
  const Image encoded = readImageFile(folder / "a.png").image;
  const Rgb raw =
      bench.makeSpectrum("imagemap", file("a.png").word("gamma", "false", ParameterType::Bool))
          ->evaluate(atUv(0, 0));
  EXPECT_FLOAT_EQ(raw.g, encoded.at(0, 0, 1));
  // A float texture decodes the luminance of the encoded values.
  const float value = bench.makeFloat("imagemap", file("a.png"))->evaluate(atUv(0, 0));
  EXPECT_NEAR(value, srgbToLinear(encoded.rgb(0, 0).luminance()), 1e-6);
  const float linear = bench.makeFloat("imagemap", file("a.exr"))->evaluate(atUv(0, 0));
  EXPECT_NEAR(linear, Rgb(0.2f, 0.5f, 0.8f).luminance(), 1e-6);
  const float forced =
      bench.makeFloat("imagemap", file("a.exr").word("gamma", "true", ParameterType::Bool))
          ->evaluate(atUv(0, 0));
  EXPECT_NEAR(forced, srgbToLinear(Rgb(0.2f, 0.5f, 0.8f).luminance()), 1e-6);
}

TEST_F(ImagemapTest, GreyAndAlphaImages) {
  Image image(1, 1, 2);
  image.at(0, 0, 0) = 0.5f;
  image.at(0, 0, 1) = 0.1f;
  writeImageFile(folder / "a.png", image);
  EXPECT_NEAR(bench.makeFloat("imagemap", file("a.png"))->evaluate(atUv(0, 0)), 0.5f, 0.005);
  const Rgb c =
      bench.makeSpectrum("imagemap", file("a.png").number("scale", 3))->evaluate(atUv(0, 0));
  EXPECT_NEAR(c.r, 1.5f, 0.01);
  EXPECT_EQ(c.r, c.b);
}

TEST_F(ImagemapTest, FootprintsChooseTheFilter) {
  // Columns of black and white: any wide filter sees grey.
  Image image(64, 64, 1);
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x) image.at(x, y, 0) = static_cast<float>(x % 2);
  writeImageFile(folder / "a.pfm", image);
  const auto sharp = bench.makeFloat("imagemap", file("a.pfm"));
  const auto trilinear =
      bench.makeFloat("imagemap", file("a.pfm").word("trilinear", "true", ParameterType::Bool));
  SurfaceInteraction s = atUv(20.5f / 64, 0.4f);
  EXPECT_NEAR(sharp->evaluate(s), 0, 1e-5);
  EXPECT_NEAR(trilinear->evaluate(s), 0, 1e-5);
  // Long along the columns, thin across: trilinear filtering blurs, elliptical doesn't.
  s.duvdx = {0.05f / 64, 0};
  s.duvdy = {0, 0.4f / 64};
  EXPECT_LT(sharp->evaluate(s), 0.3f);
  s.duvdy = {0, 4.f / 64};
  EXPECT_NEAR(trilinear->evaluate(s), 0.5f, 1e-4);
  s.duvdx = {4.f / 64, 0};
  EXPECT_NEAR(sharp->evaluate(s), 0.5f, 1e-3);
}

TEST_F(ImagemapTest, FilesAreReadOnce) {
  writeImageFile(folder / "a.pfm", gradient(2, 2, 3));
  const auto first = bench.makeSpectrum("imagemap", file("a.pfm"));
  std::filesystem::remove(folder / "a.pfm");
  const auto second =
      bench.makeSpectrum("imagemap", file("a.pfm")
                                         .number("uscale", 2)
                                         .number("scale", 2)
                                         .word("trilinear", "true", ParameterType::Bool));
  EXPECT_EQ(second->evaluate(atUv(0.125f, 0.25f)), 2 * first->evaluate(atUv(0.25f, 0.25f)));
}

TEST_F(ImagemapTest, FaultsNameTheFile) {
  EXPECT_NE(errorOf(file("missing.png")).find("missing.png"), std::string::npos);
  writeBytes(folder / "bad.png", "no image at all");
  EXPECT_NE(errorOf(file("bad.png")).find("bad.png"), std::string::npos);
  EXPECT_NE(errorOf(file("a.gif")).find(".exr"), std::string::npos);
  EXPECT_NE(errorOf(Parameters()).find("filename"), std::string::npos);
}

TEST_F(ImagemapTest, ValuesThatAreNoNumbersAreBlackAndReported) {
  Image image(2, 1, 3);
  image.setRgb(0, 0, Rgb(1, std::nanf(""), 1));
  image.setRgb(1, 0, Rgb(0.5f));
  writeImageFile(folder / "a.exr", image);
  const auto t = bench.makeSpectrum("imagemap", file("a.exr"));
  EXPECT_EQ(t->evaluate(atUv(0.25f, 0.5f)), Rgb(0));
  EXPECT_EQ(t->evaluate(atUv(0.75f, 0.5f)), Rgb(0.5f));
  ASSERT_EQ(bench.warnings.size(), 1u);
  EXPECT_NE(bench.warnings[0].find("1 pixels"), std::string::npos);
}

}  // namespace
}  // namespace lampyris
