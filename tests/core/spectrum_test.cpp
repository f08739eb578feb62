// SPDX-License-Identifier: Apache-2.0
#include "core/spectrum.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace lampyris {
namespace {

/// CIE chromaticity of a linear sRGB colour (IEC 61966-2-1).
Vec2 chromaticity(const Rgb& c) {
  const float x = 0.4124f * c.r + 0.3576f * c.g + 0.1805f * c.b;
  const float y = 0.2126f * c.r + 0.7152f * c.g + 0.0722f * c.b;
  const float z = 0.0193f * c.r + 0.1192f * c.g + 0.9505f * c.b;
  return {x / (x + y + z), y / (x + y + z)};
}

TEST(Spectrum, FlatOneIsEqualEnergyWhite) {
  const std::vector<float> flat{400, 1, 700, 1};
  const Rgb c = spectrumToRgb(flat);
  EXPECT_NEAR(c.luminance(), 470 / 471., 2e-4);
  const Vec2 xy = chromaticity(c);
  EXPECT_NEAR(xy.x, 1 / 3., 2e-3);
  EXPECT_NEAR(xy.y, 1 / 3., 2e-3);
}

TEST(Spectrum, IsLinearAndOrderDoesNotMatter) {
  const Rgb a = spectrumToRgb(std::vector<float>{400, 0.2f, 500, 1, 650, 0.5f});
  const Rgb b = spectrumToRgb(std::vector<float>{650, 0.5f, 400, 0.2f, 500, 1});
  const Rgb twice = spectrumToRgb(std::vector<float>{400, 0.4f, 500, 2, 650, 1});
  EXPECT_EQ(a, b);
  EXPECT_NEAR(twice.r, 2 * a.r, 1e-5);
  EXPECT_NEAR(twice.g, 2 * a.g, 1e-5);
  EXPECT_NEAR(twice.b, 2 * a.b, 1e-5);
}

TEST(Spectrum, BandsHaveTheirColours) {
  const Rgb red = spectrumToRgb(std::vector<float>{599, 0, 600, 1, 700, 1, 701, 0});
  EXPECT_GT(red.r, 3 * std::abs(red.g));
  EXPECT_GT(red.r, 3 * std::abs(red.b));
  const Rgb green = spectrumToRgb(std::vector<float>{499, 0, 500, 1, 570, 1, 571, 0});
  EXPECT_GT(green.g, 2 * std::abs(green.r));
  EXPECT_GT(green.g, 2 * std::abs(green.b));
  const Rgb blue = spectrumToRgb(std::vector<float>{419, 0, 420, 1, 480, 1, 481, 0});
  EXPECT_GT(blue.b, 3 * std::abs(blue.r));
  EXPECT_GT(blue.b, 3 * std::abs(blue.g));
}

TEST(Spectrum, CopperLooksLikeCopper) {
  // Reflectance of polished copper at normal incidence, about.
  const Rgb c = spectrumToRgb(std::vector<float>{400, 0.47f, 450, 0.55f, 500, 0.57f, 550, 0.65f,
                                                 575, 0.78f, 600, 0.92f, 650, 0.96f, 700, 0.97f});
  // Relative to what a perfect mirror of equal-energy white would show.
  const Rgb white = spectrumToRgb(std::vector<float>{400, 1, 700, 1});
  EXPECT_GT(c.r, c.g);
  EXPECT_GT(c.g, c.b);
  EXPECT_NEAR(c.r / white.r, 0.97, 0.06);
  EXPECT_NEAR(c.g / white.g, 0.67, 0.06);
  EXPECT_NEAR(c.b / white.b, 0.53, 0.06);
}

TEST(Spectrum, EdgeCases) {
  EXPECT_EQ(spectrumToRgb({}), Rgb());
  EXPECT_EQ(spectrumToRgb(std::vector<float>{500}), Rgb());
  // One point stands for a constant.
  const Rgb one = spectrumToRgb(std::vector<float>{500, 1});
  const Rgb flat = spectrumToRgb(std::vector<float>{300, 1, 900, 1});
  EXPECT_NEAR(one.g, flat.g, 1e-6);
  // A step: the wavelength stands twice.
  EXPECT_TRUE(spectrumToRgb(std::vector<float>{400, 0, 500, 0, 500, 1, 700, 1}).isFinite());
  EXPECT_EQ(spectrumToRgb(std::vector<float>{400, 0, 700, 0}), Rgb());
}

TEST(Spectrum, XyzOfWhite) {
  const Rgb d65 = xyzToRgb({0.950456f, 1, 1.089058f});
  EXPECT_NEAR(d65.r, 1, 1e-3);
  EXPECT_NEAR(d65.g, 1, 1e-3);
  EXPECT_NEAR(d65.b, 1, 1e-3);
  EXPECT_EQ(xyzToRgb(Vec3(0)), Rgb());
}

TEST(Blackbody, ColoursOfTemperatures) {
  // Chromaticities on the Planckian locus (Kang et al. 2002).
  const auto expectColour = [](float kelvin, float x, float y) {
    const Vec2 xy = chromaticity(blackbodyRgb(kelvin));
    EXPECT_NEAR(xy.x, x, 3e-3) << kelvin;
    EXPECT_NEAR(xy.y, y, 3e-3) << kelvin;
  };
  expectColour(2856, 0.4476f, 0.4074f);
  expectColour(5000, 0.3451f, 0.3516f);
  expectColour(6500, 0.3135f, 0.3237f);
  expectColour(10000, 0.2807f, 0.2884f);
  const Rgb white = blackbodyRgb(6500);
  EXPECT_NEAR(white.r / white.g, 1, 0.08);
  EXPECT_NEAR(white.b / white.g, 1, 0.08);
}

TEST(Blackbody, ScaledToItsMaximum) {
  // At 5000 K the maximum, 1, lies in the visible range, and the spectrum is flat there.
  EXPECT_NEAR(blackbodyRgb(5000).luminance(), 0.98, 0.03);
  // Far away from it nothing is left.
  EXPECT_LT(blackbodyRgb(300).luminance(), 1e-10f);
}

TEST(Blackbody, AnyTemperatureIsFinite) {
  for (const float k :
       {-1.f, 0.f, std::numeric_limits<float>::quiet_NaN(), std::numeric_limits<float>::infinity()})
    EXPECT_EQ(blackbodyRgb(k), Rgb());
  for (const float k : {1e-45f, 1e-30f, 1e-3f, 1.f, 100.f, 1e6f, 1e20f, 3e38f})
    EXPECT_TRUE(blackbodyRgb(k).isFinite()) << k;
}

}  // namespace
}  // namespace lampyris
