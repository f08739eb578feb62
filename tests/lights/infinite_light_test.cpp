// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "core/frame.h"
#include "light_maker.h"
#include "support/statistics.h"

namespace lampyris::test {
namespace {

/// A map of random texels, one of them very bright.
std::string writeMap(const std::string& name, int width, int height, float bright) {
  Image image(width, height, 3);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      const auto at = static_cast<uint64_t>(y * width + x);
      image.setRgb(x, y, Rgb(uniform(3, at, 0), uniform(3, at, 1), uniform(3, at, 2)) + Rgb(0.05f));
    }
  image.setRgb(width / 3, height / 3, Rgb(bright));
  const std::string path = testing::TempDir() + name;
  writeImageFile(path, image);
  return path;
}

Vec3 direction(int i, int j, int cells) {
  const float c = 1 - 2 * (static_cast<float>(i) + 0.5f) / static_cast<float>(cells);
  const float phi = 2 * kPi * (static_cast<float>(j) + 0.5f) / static_cast<float>(cells);
  return sphericalDirection(std::sqrt(1 - c * c), c, phi);
}

/// ∫ L cos⁺ dω by quadrature, of the luminance.
double irradiance(const Light& light, const Vec3& n, bool bothSides) {
  const int cells = 400;
  double sum = 0;
  for (int i = 0; i < cells; ++i)
    for (int j = 0; j < cells; ++j) {
      const Vec3 w = direction(i, j, cells);
      const float cosine = bothSides ? std::abs(dot(n, w)) : std::max(dot(n, w), 0.f);
      sum += static_cast<double>(light.escaped(w).luminance() * cosine);
    }
  return sum * 4 * 3.14159265358979 / (cells * cells);
}

std::vector<double> irradianceSamples(const Light& light, const Vec3& n, int count) {
  std::vector<double> values;
  for (int i = 0; i < count; ++i) {
    const auto at = static_cast<uint64_t>(i);
    const auto s = light.sample(0, {1, 2, 3}, {uniform(1, at, 0), uniform(1, at, 1)});
    values.push_back(
        s ? static_cast<double>(s->radiance.luminance() * std::max(dot(n, s->wi), 0.f) / s->pdf)
          : 0);
  }
  return values;
}

TEST(InfiniteLight, ConstantGivesPiL) {
  LightMaker maker;
  const auto light = maker.make("infinite", {{"L", "2 2 2"}});
  const auto values = irradianceSamples(*light, normalize(Vec3(1, 2, -1)), 50'000);
  const double lum = static_cast<double>(Rgb(2).luminance());
  EXPECT_EQ(meanTest(values, lum * 3.14159265358979, 1e-4), "");
  EXPECT_FLOAT_EQ(light->irradianceEstimate({0, 0, 1}, false), kPi * Rgb(2).luminance());
  EXPECT_FLOAT_EQ(light->irradianceEstimate({0, 0, 1}, true), 2 * kPi * Rgb(2).luminance());
}

TEST(InfiniteLight, MapConventions) {
  // Top row: z up. Columns: φ from +x to +y.
  Image image(8, 4, 3);
  for (int x = 0; x < 8; ++x) {
    image.setRgb(x, 0, Rgb(10));
    image.setRgb(x, 1, Rgb(static_cast<float>(x)));
    image.setRgb(x, 2, Rgb(static_cast<float>(x)));
  }
  const std::string path = testing::TempDir() + "conventions.pfm";
  writeImageFile(path, image);
  LightMaker maker;
  const auto light = maker.make("infinite", {{"mapname", path}});
  EXPECT_FLOAT_EQ(light->escaped({0, 0, 2}).r, 5) << "wraps to the bottom row, as in pbrt-v3";
  EXPECT_NEAR(light->escaped(sphericalDirection(std::sin(kPi / 8), std::cos(kPi / 8), 1)).r, 10,
              1e-4);
  for (int x = 0; x < 8; ++x) {
    const float phi = (static_cast<float>(x) + 0.5f) * 2 * kPi / 8;
    EXPECT_NEAR(light->escaped(sphericalDirection(1, 0, phi)).r, static_cast<float>(x), 1e-4);
  }
  const auto turned = maker.make("infinite", {{"mapname", path}}, Transform::rotate(90, {0, 0, 1}));
  EXPECT_NEAR(turned->escaped(sphericalDirection(1, 0, 1.5f * 2 * kPi / 8 + kPi / 2)).r, 1, 1e-4);
}

class MappedLight : public testing::TestWithParam<float> {};

TEST_P(MappedLight, SamplesItsMap) {
  LightMaker maker;
  const std::string path = writeMap("map" + std::to_string(GetParam()) + ".pfm", 17, 9, GetParam());
  const std::vector<Transform> transforms{Transform(), Transform::rotate(70, {1, 2, 3}),
                                          Transform::scale({1, 2, 0.5f})};
  for (const Transform& t : transforms) {
    const auto light = maker.make("infinite", {{"mapname", path}, {"L", "1 2 0.5"}}, t);
    const Vec3 n = normalize(Vec3(-1, 0.3f, 0.6f));
    const double expected = irradiance(*light, n, false);
    EXPECT_EQ(meanTest(irradianceSamples(*light, n, 40'000), expected, 5e-3 * expected), "");

    DirectionTest test;
    test.sample = [&](const Vec2& u, float, Vec3& w) {
      const auto s = light->sample(0, Vec3(0), u);
      if (s) w = s->wi;
      return s.has_value();
    };
    test.pdf = [&](const Vec3& w) { return static_cast<double>(light->pdfEscape(w)); };
    test.samples = 30'000;
    // The steps around the bright texel must be resolved by the quadrature.
    test.subdivisions = 32;
    EXPECT_EQ(directionChiSquareTest(test), "");
    for (uint64_t i = 0; i < 1000; ++i) {
      const auto s = light->sample(0, Vec3(0), {uniform(2, i, 0), uniform(2, i, 1)});
      ASSERT_TRUE(s);
      EXPECT_EQ(s->pdf, light->pdfEscape(s->wi));
      EXPECT_EQ(s->radiance, light->escaped(s->wi));
      EXPECT_NEAR(length(s->wi), 1, 1e-5);
    }
  }
}

TEST_P(MappedLight, EstimatesIrradiance) {
  LightMaker maker;
  const std::string path = writeMap("map" + std::to_string(GetParam()) + ".pfm", 17, 9, GetParam());
  const auto light = maker.make("infinite", {{"mapname", path}}, Transform::rotate(20, {0, 1, 0}));
  double flux = 0;  // ∫ L dω, as if all of it came from one direction
  for (const Vec3& n : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1)})
    flux = std::max(flux, irradiance(*light, n, true));
  for (uint64_t i = 0; i < 10; ++i) {
    const Vec3 n = sphericalDirection(1, 0, 6 * uniform(9, i, 0)) + Vec3(0, 0, uniform(9, i, 1));
    for (const bool both : {false, true}) {
      const double exact = irradiance(*light, normalize(n), both);
      const auto estimate = static_cast<double>(light->irradianceEstimate(normalize(n), both));
      EXPECT_NEAR(estimate, exact, 0.2 * flux);
    }
  }
  // The power is that of the map's mean radiance.
  light->prepare(Bounds3(Vec3(-1), Vec3(1)));
  double sum = 0;
  for (int i = 0; i < 200; ++i)
    for (int j = 0; j < 200; ++j)
      sum += static_cast<double>(light->escaped(direction(i, j, 200)).luminance());
  const double expected = sum / 40'000 * 3.14159265358979 * 3;
  EXPECT_NEAR(static_cast<double>(light->power(0).luminance()), expected, 0.01 * expected);
}

INSTANTIATE_TEST_SUITE_P(Contrasts, MappedLight, testing::Values(0.5f, 20.f));

TEST(InfiniteLight, NoLightWithoutDensity) {
  // A dim sky that rounds to nothing beside a sun of 1e9 still has to be drawn.
  Image image(256, 128, 3);
  for (float& v : image.data()) v = 1e-3f;
  image.setRgb(100, 40, Rgb(1e9f));
  for (int x = 0; x < 256; ++x) image.setRgb(x, 90, Rgb(0));
  const std::string path = testing::TempDir() + "sun.pfm";
  writeImageFile(path, image);
  LightMaker maker;
  const auto light = maker.make("infinite", {{"mapname", path}});
  for (int i = 0; i < 300; ++i)
    for (int j = 0; j < 300; ++j) {
      const Vec3 w = direction(i, j, 300);
      if (!light->escaped(w).isBlack()) {
        EXPECT_GT(light->pdfEscape(w), 0);
      }
    }
}

TEST(InfiniteLight, BadTexelsCountAsBlack) {
  Image image(4, 2, 3);
  for (float& v : image.data()) v = 1;
  image.setRgb(1, 0, Rgb(std::nanf("")));
  image.setRgb(2, 1, Rgb(-5));
  const std::string path = testing::TempDir() + "bad.pfm";
  writeImageFile(path, image);
  LightMaker maker;
  const auto light = maker.make("infinite", {{"mapname", path}});
  EXPECT_EQ(maker.build.warnings.size(), 1u);
  for (int i = 0; i < 20; ++i)
    for (int j = 0; j < 20; ++j) {
      const Rgb c = light->escaped(direction(i, j, 20));
      EXPECT_TRUE(c.isFinite() && c.r >= 0 && c.r <= 1.0001f);
    }
  const auto black = maker.make("infinite", {{"mapname", path}, {"scale", "0 0 0"}});
  EXPECT_TRUE(black->power(0).isBlack());
  EXPECT_FALSE(black->sample(0, Vec3(0), {0.3f, 0.4f}));
}

}  // namespace
}  // namespace lampyris::test
