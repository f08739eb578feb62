// SPDX-License-Identifier: Apache-2.0
#include "textures/image_pyramid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "support/statistics.h"

namespace lampyris {
namespace {

std::vector<float> noise(int width, int height) {
  std::vector<float> v(static_cast<size_t>(width * height));
  for (size_t i = 0; i < v.size(); ++i) v[i] = test::uniform(3, i, 0);
  return v;
}

double meanOf(const ImagePyramid<float>& p, int level) {
  const Int2 size = p.size(level);
  double sum = 0;
  for (int t = 0; t < size.y; ++t)
    for (int s = 0; s < size.x; ++s) sum += static_cast<double>(p.texel(level, s, t));
  return sum / (size.x * size.y);
}

TEST(ImagePyramid, LevelsHalveAndKeepTheMean) {
  for (const ImageWrap wrap : {ImageWrap::Repeat, ImageWrap::Black, ImageWrap::Clamp}) {
    const std::vector<float> texels = noise(32, 4);
    const ImagePyramid<float> p(32, 4, texels, wrap);
    ASSERT_EQ(p.levelCount(), 6);
    EXPECT_EQ(p.size(0), Int2(32, 4));
    EXPECT_EQ(p.size(3), Int2(4, 1));
    EXPECT_EQ(p.size(5), Int2(1, 1));
    EXPECT_EQ(p.texel(0, 5, 2), texels[2 * 32 + 5]);
    for (int level = 1; level < 6; ++level) EXPECT_NEAR(meanOf(p, level), meanOf(p, 0), 1e-6);
  }
}

TEST(ImagePyramid, Wraps) {
  const std::vector<float> texels = {1, 2, 3, 4};  // 2 × 2
  const ImagePyramid<float> repeat(2, 2, texels, ImageWrap::Repeat);
  EXPECT_EQ(repeat.texel(0, -1, 0), 2);
  EXPECT_EQ(repeat.texel(0, 2, 3), 3);
  const ImagePyramid<float> clamp(2, 2, texels, ImageWrap::Clamp);
  EXPECT_EQ(clamp.texel(0, -7, 0), 1);
  EXPECT_EQ(clamp.texel(0, 2, 9), 4);
  const ImagePyramid<float> black(2, 2, texels, ImageWrap::Black);
  EXPECT_EQ(black.texel(0, -1, 0), 0);
  EXPECT_EQ(black.texel(0, 0, 2), 0);
  EXPECT_EQ(black.texel(0, 1, 1), 4);
  // Bilinear over the left edge: half of the texel beyond.
  EXPECT_FLOAT_EQ(repeat.bilinear(0, {0, 0.25f}), 1.5f);
  EXPECT_FLOAT_EQ(clamp.bilinear(0, {0, 0.25f}), 1);
  EXPECT_FLOAT_EQ(black.bilinear(0, {0, 0.25f}), 0.5f);
}

TEST(ImagePyramid, BilinearPassesThroughTexelCentres) {
  const std::vector<float> texels = noise(8, 4);
  const ImagePyramid<float> p(8, 4, texels, ImageWrap::Repeat);
  for (int t = 0; t < 4; ++t)
    for (int s = 0; s < 8; ++s) {
      const Vec2 centre((static_cast<float>(s) + 0.5f) / 8, (static_cast<float>(t) + 0.5f) / 4);
      EXPECT_NEAR(p.bilinear(0, centre), p.texel(0, s, t), 1e-6);
      EXPECT_NEAR(p.bilinear(0, centre + Vec2(3, -2)), p.texel(0, s, t), 1e-5);
    }
  EXPECT_NEAR(p.bilinear(0, {1 / 8.f, 1 / 4.f}),
              (texels[0] + texels[1] + texels[8] + texels[9]) / 4, 1e-6);
}

TEST(ImagePyramid, ResamplingKeepsConstantsAndWidensToPowersOfTwo) {
  for (const ImageWrap wrap : {ImageWrap::Repeat, ImageWrap::Clamp}) {
    const ImagePyramid<Rgb> p(5, 3, std::vector<Rgb>(15, Rgb(0.25f, 0.5f, 2)), wrap);
    EXPECT_EQ(p.size(0), Int2(8, 4));
    for (int t = 0; t < 4; ++t)
      for (int s = 0; s < 8; ++s) {
        EXPECT_NEAR(p.texel(0, s, t).r, 0.25f, 1e-5);
        EXPECT_NEAR(p.texel(0, s, t).b, 2, 1e-5);
      }
  }
  // An edge overshoots; what would be negative is clipped.
  std::vector<float> edge(30, 0.f);
  for (size_t i = 0; i < edge.size(); i += 5) edge[i + 2] = edge[i + 3] = 1;
  const ImagePyramid<float> p(5, 6, edge, ImageWrap::Clamp);
  float smallest = 1, largest = 0;
  for (int s = 0; s < 8; ++s) {
    smallest = std::min(smallest, p.texel(0, s, 3));
    largest = std::max(largest, p.texel(0, s, 3));
  }
  EXPECT_EQ(smallest, 0);
  EXPECT_GT(largest, 0.95f);
}

TEST(ImagePyramid, ResamplingWeightsByHand) {
  // Three texels to four: the second new centre lies at 1.125, so texel 1's centre is 0.375 away,
  // texel 0's 0.625, texel 2's 1.375, texel −1's 1.625 (beyond the image: black).
  const ImagePyramid<float> p(3, 1, {1, 0, 0}, ImageWrap::Black);
  const auto lanczos = [](double x) {
    const double y = M_PI * x / 2;
    return std::sin(2 * y) / (2 * y) * std::sin(y) / y;
  };
  const double sum = lanczos(1.625) + lanczos(0.625) + lanczos(0.375) + lanczos(1.375);
  EXPECT_NEAR(p.texel(0, 1, 0), lanczos(0.625) / sum, 1e-5);
}

TEST(ImagePyramid, TrilinearBlendsLevels) {
  const ImagePyramid<float> p(16, 16, noise(16, 16), ImageWrap::Repeat);
  const Vec2 st(0.3f, 0.8f);
  EXPECT_EQ(p.trilinear(st, 0), p.bilinear(0, st));
  EXPECT_EQ(p.trilinear(st, 1 / 32.f), p.bilinear(0, st));
  EXPECT_NEAR(p.trilinear(st, 1 / 8.f), p.bilinear(1, st), 1e-6);
  const float half = std::sqrt(2.f) / 16;
  EXPECT_NEAR(p.trilinear(st, half), 0.5f * (p.bilinear(0, st) + p.bilinear(1, st)), 1e-5);
  EXPECT_EQ(p.trilinear(st, 1), p.texel(4, 0, 0));
  EXPECT_EQ(p.trilinear(st, 1e30f), p.texel(4, 0, 0));
}

TEST(ImagePyramid, EllipticalOfAConstantIsConstant) {
  const ImagePyramid<float> p(32, 8, std::vector<float>(256, 0.7f), ImageWrap::Repeat);
  for (uint64_t i = 0; i < 2000; ++i) {
    const auto d = [i](uint32_t k) {
      return (2 * test::uniform(1, i, k) - 1) * std::exp2(-12 * test::uniform(2, i, k));
    };
    EXPECT_NEAR(p.elliptical({d(0) * 5, d(1) * 5}, {d(2), d(3)}, {d(4), d(5)}, 8), 0.7f, 1e-5);
  }
}

TEST(ImagePyramid, EllipticalIsTheGaussianAverage) {
  // The pyramid blurs a little more than the ellipse alone (by about a texel of the level).
  constexpr int kSize = 256;
  std::vector<float> texels(kSize * kSize);
  const auto value = [](double s, double t) {
    return 0.5 + 0.25 * std::sin(2 * M_PI * 2 * s) + 0.2 * std::cos(2 * M_PI * 3 * (t - s));
  };
  for (int t = 0; t < kSize; ++t)
    for (int s = 0; s < kSize; ++s)
      texels[static_cast<size_t>(t * kSize + s)] =
          static_cast<float>(value((s + 0.5) / kSize, (t + 0.5) / kSize));
  const ImagePyramid<float> p(kSize, kSize, texels, ImageWrap::Repeat);
  double error = 0, unfilteredError = 0;
  for (uint64_t i = 0; i < 20; ++i) {
    const auto u = [i](uint32_t k) { return test::uniform(9, i, k); };
    const Vec2 st(u(0), u(1));
    const float angle = 6 * u(2), major = 0.05f + 0.1f * u(3), minor = major * (0.3f + 0.6f * u(4));
    const Vec2 d0 = major * Vec2(std::cos(angle), std::sin(angle));
    const Vec2 d1 = minor * Vec2(-std::sin(angle), std::cos(angle));
    double sum = 0, weights = 0;
    for (int y = -50; y <= 50; ++y)
      for (int x = -50; x <= 50; ++x) {
        const double a = x / 50., b = y / 50., r2 = a * a + b * b;
        if (r2 >= 1) continue;
        const double w = std::exp(-2 * r2) - std::exp(-2.);
        sum += w * value(static_cast<double>(st.x) + a * static_cast<double>(d0.x) +
                             b * static_cast<double>(d1.x),
                         static_cast<double>(st.y) + a * static_cast<double>(d0.y) +
                             b * static_cast<double>(d1.y));
        weights += w;
      }
    const auto filtered = static_cast<double>(p.elliptical(st, d0, d1, 8));
    EXPECT_NEAR(filtered, sum / weights, 0.065) << i;
    error += std::abs(filtered - sum / weights);
    unfilteredError += std::abs(static_cast<double>(p.bilinear(0, st)) - sum / weights);
    EXPECT_NEAR(p.elliptical(st, d1, d0, 8), p.elliptical(st, d0, d1, 8), 1e-6);
  }
  EXPECT_LT(error, 0.55 * unfilteredError);
}

TEST(ImagePyramid, EllipticalIsCentred) {
  std::vector<float> ramp(128 * 64);
  for (size_t i = 0; i < ramp.size(); ++i)
    ramp[i] =
        (static_cast<float>(i % 128) + 0.5f) / 128 - 2 * (static_cast<float>(i / 128) + 0.5f) / 64;
  const ImagePyramid<float> p(128, 64, ramp, ImageWrap::Clamp);
  for (uint64_t i = 0; i < 50; ++i) {
    const auto u = [i](uint32_t k) { return test::uniform(5, i, k); };
    const Vec2 st(0.35f + 0.3f * u(0), 0.35f + 0.3f * u(1));
    EXPECT_NEAR(p.elliptical(st, {0.05f * u(2), 0.02f}, {-0.01f, 0.05f * u(3)}, 8), st.x - 2 * st.y,
                0.01);
  }
}

TEST(ImagePyramid, EllipticalLimits) {
  const ImagePyramid<float> p(16, 16, noise(16, 16), ImageWrap::Repeat);
  const Vec2 st(0.3f, 0.8f);
  EXPECT_EQ(p.elliptical(st, {0, 0}, {0, 0}, 8), p.bilinear(0, st));
  EXPECT_EQ(p.elliptical(st, {0.1f, 0}, {0, 0}, 8), p.bilinear(0, st));
  EXPECT_EQ(p.elliptical(st, {4, 0}, {0, 4}, 8), p.texel(4, 0, 0));
  // A thin ellipse is made as wide as an eighth of its length: then it is blurred across, too.
  EXPECT_NEAR(p.elliptical(st, {0.8f, 0}, {0, 1e-6f}, 8), p.elliptical(st, {0.8f, 0}, {0, 0.1f}, 8),
              1e-5);
}

TEST(ImagePyramid, AnyNumberIsHarmless) {
  const float inf = std::numeric_limits<float>::infinity(), nan = std::nanf("");
  for (const ImageWrap wrap : {ImageWrap::Repeat, ImageWrap::Black, ImageWrap::Clamp}) {
    const ImagePyramid<float> p(16, 4, noise(16, 4), wrap);
    for (const float v : {inf, -inf, nan, 1e30f, -1e30f, 3e9f})
      for (const float d : {0.f, 1e-30f, 0.1f, 1e20f, inf, nan}) {
        EXPECT_TRUE(std::isfinite(p.bilinear(0, {v, 0.5f})));
        EXPECT_TRUE(std::isfinite(p.trilinear({0.5f, v}, d)));
        EXPECT_TRUE(std::isfinite(p.elliptical({v, v}, {d, 0.1f}, {0.1f, -d}, 8)));
        EXPECT_TRUE(std::isfinite(p.elliptical({0.5f, v}, {d, d}, {0.f, 0.1f}, 8)));
      }
  }
}

TEST(ImagePyramid, OneTexel) {
  const ImagePyramid<Rgb> p(1, 1, {Rgb(1, 2, 3)}, ImageWrap::Repeat);
  EXPECT_EQ(p.levelCount(), 1);
  EXPECT_EQ(p.bilinear(0, {0.9f, -4}), Rgb(1, 2, 3));
  EXPECT_EQ(p.trilinear({0, 0}, 0.5f), Rgb(1, 2, 3));
  EXPECT_NEAR(p.elliptical({0, 0}, {0.1f, 0}, {0, 0.1f}, 8).g, 2, 1e-6);
}

}  // namespace
}  // namespace lampyris
