// SPDX-License-Identifier: Apache-2.0
#include "tools/compare.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "support/statistics.h"
#include "tools/error_image.h"

namespace lampyris {
namespace {

Image filled(int width, int height, const Rgb& c) {
  Image image(width, height, 3);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) image.setRgb(x, y, c);
  return image;
}

TEST(Compare, EqualImages) {
  const Image a = filled(4, 3, Rgb(1, 2, 3));
  const Comparison c = compareImages(a, a);
  EXPECT_EQ(c.error, "");
  EXPECT_EQ(c.pixels, 12u);
  EXPECT_EQ(c.mse, 0);
  EXPECT_EQ(c.maxError, 0);
  EXPECT_EQ(c.meanRatio, 1);
  EXPECT_EQ(c.relMse, 0);
  EXPECT_EQ(c.trimmedRelMse, 0);
}

TEST(Compare, FiguresByHand) {
  Image a = filled(2, 1, Rgb(1)), b = filled(2, 1, Rgb(2));
  a.setRgb(1, 0, Rgb(2, 2, 5));
  const Comparison c = compareImages(a, b);
  // Differences 1 1 1 0 0 3.
  EXPECT_DOUBLE_EQ(c.mse, 12. / 6);
  EXPECT_DOUBLE_EQ(c.rmse, std::sqrt(2.));
  EXPECT_DOUBLE_EQ(c.mae, 1);
  EXPECT_EQ(c.maxError, 3);
  EXPECT_DOUBLE_EQ(*c.meanRatio, 1);
  const double epsilon = 0.02 * 0.02;
  EXPECT_DOUBLE_EQ(*c.relMse, 2 / (4 + epsilon));
  // Two pixels: the worse one is left out.
  EXPECT_DOUBLE_EQ(*c.trimmedRelMse, 1 / (4 + epsilon));
}

TEST(Compare, RelativeErrorsDoNotDependOnScale) {
  Image a(8, 8, 3), b(8, 8, 3);
  for (size_t i = 0; i < a.data().size(); ++i) {
    a.data()[i] = static_cast<float>(i % 7);
    b.data()[i] = static_cast<float>(i % 5);
  }
  const Comparison c = compareImages(a, b);
  for (Image* image : {&a, &b})
    for (float& v : image->data()) v *= 0x1p-40f;
  const Comparison scaled = compareImages(a, b);
  EXPECT_NEAR(*scaled.relMse, *c.relMse, 1e-9 * *c.relMse);
  EXPECT_NEAR(*scaled.trimmedRelMse, *c.trimmedRelMse, 1e-9 * *c.relMse);
}

TEST(Compare, TrimmingRemovesFireflies) {
  Image a = filled(100, 20, Rgb(1.1f));
  const Image b = filled(100, 20, Rgb(1));
  a.setRgb(3, 3, Rgb(1e4f));
  a.setRgb(4, 3, Rgb(1e4f));
  const Comparison c = compareImages(a, b);
  EXPECT_GT(*c.relMse, 1e4);
  EXPECT_NEAR(*c.trimmedRelMse, 0.01, 1e-4);
}

TEST(Compare, RobustErrorIsBounded) {
  const Image b = filled(10, 10, Rgb(1));
  Image a = filled(10, 10, Rgb(1.01f));
  EXPECT_NEAR(*compareImages(a, b).robustRelMse, 1e-4, 2e-6);
  EXPECT_NEAR(*compareImages(a, b).relMse, 1e-4, 1e-6);
  a.setRgb(0, 0, Rgb(1e20f));
  const Comparison c = compareImages(a, b);
  EXPECT_NEAR(*c.robustRelMse, 2. / 100 + 0.99e-4, 1e-5);
  EXPECT_GT(*c.relMse, 1e30);
}

TEST(Compare, MeanRatiosByHand) {
  Image a(4, 4, 3), b(4, 4, 3);
  double squares = 0;
  for (int i = 0; i < 16; ++i) {
    const bool odd = i % 2;
    a.setRgb(i % 4, i / 4, Rgb(odd ? 3.f : 1.f, 2, 0));
    b.setRgb(i % 4, i / 4, Rgb(1, 4, 1));
    squares += 1;  // (3 − 2·1)² or (1 − 2·1)²
  }
  const MeanRatios r = meanRatios(a, b);
  EXPECT_DOUBLE_EQ(r[0]->ratio, 2);
  const double half = 1.959963984540054 * std::sqrt(16. / 15 * squares) / 16;
  EXPECT_NEAR(r[0]->low, 2 - half, 1e-12);
  EXPECT_NEAR(r[0]->high, 2 + half, 1e-12);
  EXPECT_DOUBLE_EQ(r[1]->ratio, 0.5);
  EXPECT_DOUBLE_EQ(r[1]->low, 0.5);
  EXPECT_DOUBLE_EQ(r[2]->ratio, 0);
  EXPECT_TRUE(std::isinf(meanRatios(filled(2, 2, Rgb(1)), filled(2, 2, Rgb(1)))[0]->high));
  EXPECT_FALSE(meanRatios(a, filled(4, 4, Rgb(0)))[3]);
}

TEST(Compare, ConfidenceIntervalsHoldTheRatioAsOftenAsTheySay) {
  // Noise around a gradient; the true ratio is 1. Of 500 intervals 95 % should hold it; 430 or
  // fewer, or all of them, have a probability below 1e-10.
  int held = 0;
  for (uint64_t trial = 0; trial < 500; ++trial) {
    Image a(32, 32, 1), b(32, 32, 1);
    for (int y = 0; y < 32; ++y)
      for (int x = 0; x < 32; ++x) {
        b.at(x, y, 0) = 1 + 0.1f * static_cast<float>(x);
        a.at(x, y, 0) =
            b.at(x, y, 0) * 2 * test::uniform(trial, static_cast<uint64_t>(y * 32 + x), 0);
      }
    const auto r = meanRatios(a, b)[3];
    held += r->low <= 1 && r->high >= 1;
  }
  EXPECT_GT(held, 430);
  EXPECT_LT(held, 500);
}

TEST(Compare, JsonHoldsEveryFigure) {
  Image a = filled(9, 9, Rgb(1.5f));
  a.setRgb(0, 0, Rgb(std::nanf("")));
  const auto json = nlohmann::json::parse(comparisonJson(compareImages(a, filled(9, 9, Rgb(1)))));
  EXPECT_DOUBLE_EQ(json["mse"], 0.25);
  EXPECT_DOUBLE_EQ(json["mae"], 0.5);
  EXPECT_DOUBLE_EQ(json["meanRatio"], 1.5);
  EXPECT_DOUBLE_EQ(json["meanRatios"]["luminance"]["low"], 1.5);
  EXPECT_EQ(json["notFinite"], 1);
  EXPECT_EQ(json["pixels"], 80);
  for (const char* key : {"rmse", "maxError", "relMse", "robustRelMse", "trimmedRelMse"})
    EXPECT_TRUE(json[key].is_number()) << key;
  const auto black = nlohmann::json::parse(comparisonJson(compareImages(a, filled(9, 9, Rgb()))));
  EXPECT_TRUE(black["relMse"].is_null());
  EXPECT_TRUE(black["meanRatios"]["red"].is_null());
  EXPECT_TRUE(nlohmann::json::parse(comparisonJson(compareImages(a, Image()))).contains("error"));
}

TEST(Compare, GreyAgainstColour) {
  Image grey(2, 2, 1);
  for (float& v : grey.data()) v = 0.5f;
  EXPECT_EQ(compareImages(grey, filled(2, 2, Rgb(0.5f))).mse, 0);
}

TEST(Compare, DifferentSizesAreAnError) {
  const Comparison c = compareImages(filled(2, 2, Rgb(1)), filled(2, 3, Rgb(1)));
  EXPECT_NE(c.error.find("2 x 2 and 2 x 3"), std::string::npos);
  EXPECT_NE(formatComparison(c).find("2 x 3"), std::string::npos);
  EXPECT_NE(compareImages(Image(), Image()).error, "");
  EXPECT_THROW(errorImage(filled(2, 2, Rgb(1)), filled(2, 3, Rgb(1))), std::invalid_argument);
}

TEST(Compare, PixelsThatAreNoNumbersAreLeftOut) {
  Image a = filled(3, 1, Rgb(2)), b = filled(3, 1, Rgb(1));
  a.setRgb(0, 0, Rgb(1, std::nanf(""), 1));
  b.setRgb(1, 0, Rgb(std::numeric_limits<float>::infinity()));
  const Comparison c = compareImages(a, b);
  EXPECT_EQ(c.notFinite, 2u);
  EXPECT_EQ(c.pixels, 1u);
  EXPECT_EQ(c.mse, 1);
  EXPECT_NE(formatComparison(c).find("2 pixels"), std::string::npos);
  const Image e = errorImage(a, b);
  EXPECT_EQ(e.rgb(0, 0), Rgb(0, 1, 0));
  EXPECT_EQ(e.rgb(1, 0), Rgb(0, 1, 0));
  EXPECT_NEAR(e.rgb(2, 0).luminance(), 1, 0.01);
  const Image none = filled(1, 1, Rgb(std::nanf("")));
  EXPECT_NE(compareImages(none, none).error, "");
}

TEST(Compare, BlackReference) {
  const Image black = filled(2, 2, Rgb(0));
  const Comparison same = compareImages(black, black);
  EXPECT_EQ(same.error, "");
  EXPECT_EQ(same.mse, 0);
  EXPECT_FALSE(same.relMse || same.trimmedRelMse || same.meanRatio);
  EXPECT_NE(formatComparison(same).find("undefined"), std::string::npos);
  EXPECT_EQ(errorImage(black, black).rgb(0, 0), Rgb(0));
  EXPECT_NEAR(errorImage(filled(2, 2, Rgb(1)), black).rgb(0, 0).luminance(), 1, 0.01);
}

TEST(Compare, ErrorColoursGrowLighter) {
  // CIE lightness is linear in t.
  for (int i = 0; i <= 50; ++i) {
    const float t = static_cast<float>(i) / 50;
    const Rgb c = errorColour(t);
    EXPECT_GE(std::min({c.r, c.g, c.b}), 0);
    EXPECT_LE(c.maxComponent(), 1);
    const float lightness = 100 * t;
    const float y = lightness > 8 ? std::pow((lightness + 16) / 116, 3.f) : lightness / 903.3f;
    EXPECT_NEAR(c.luminance(), y, 2e-3) << t;
  }
  EXPECT_EQ(errorColour(-1), errorColour(0));
  EXPECT_EQ(errorColour(2), errorColour(1));
  EXPECT_EQ(errorColour(std::nanf("")), errorColour(0));
  // Colours, not greys, between: red exceeds green at the middle.
  EXPECT_GT(errorColour(0.5f).r, 2 * errorColour(0.5f).g);
}

TEST(Compare, ErrorImageIsLogarithmic) {
  const Image b = filled(4, 1, Rgb(1));
  Image a = b;
  const float root = std::sqrt(1 + 1e-4f);
  a.setRgb(1, 0, Rgb(1 + 0.001f * root));
  a.setRgb(2, 0, Rgb(1 + 0.0316228f * root));
  a.setRgb(3, 0, Rgb(3));
  const Image e = errorImage(a, b);
  EXPECT_EQ(e.rgb(0, 0), Rgb(0));
  EXPECT_LT(e.rgb(1, 0).luminance(), 1e-3);
  EXPECT_NEAR(e.rgb(2, 0).luminance(), errorColour(0.5f).luminance(), 1e-3);
  EXPECT_NEAR(e.rgb(3, 0).luminance(), 1, 1e-2);
}

}  // namespace
}  // namespace lampyris
