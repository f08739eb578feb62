// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "light_maker.h"

namespace lampyris::test {
namespace {

TEST(PointLight, InverseSquareAndTransform) {
  LightMaker maker;
  const auto light = maker.make("point", {{"I", "2 4 8"}, {"scale", "0.5 1 1"}, {"from", "1 0 0"}},
                                Transform::translate({0, 0, 3}));
  const auto s = light->sample(0, {1, 0, 1}, {0.5f, 0.5f});
  ASSERT_TRUE(s);
  EXPECT_FLOAT_EQ(s->radiance.r, 0.25f);
  EXPECT_FLOAT_EQ(s->radiance.b, 2);
  EXPECT_FLOAT_EQ(s->distance, 2);
  EXPECT_FLOAT_EQ(s->wi.z, 1);
  EXPECT_EQ(s->pdf, 1);
  EXPECT_EQ(s->n, Vec3(0));
  EXPECT_FLOAT_EQ(light->power(0).g, 16 * kPi);
  EXPECT_FLOAT_EQ(light->bounds(0)->intensity, Rgb(1, 4, 8).luminance());
  EXPECT_FALSE(light->sample(0, {1, 0, 3}, {0.5f, 0.5f})) << "at the light itself";
}

/// ∫ of the intensity over all directions, by the midpoint rule in cos θ.
double spotFlux(const Light& light, float distance) {
  const int cells = 20'000;
  double sum = 0;
  for (int i = 0; i < cells; ++i) {
    const float c = 1 - 2 * (static_cast<float>(i) + 0.5f) / static_cast<float>(cells);
    const Vec3 from = distance * Vec3(std::sqrt(1 - c * c), 0, c);
    if (const auto s = light.sample(0, from, {0.5f, 0.5f}))
      sum += static_cast<double>(s->radiance.r * sqr(s->distance));
  }
  return sum * 4 * 3.14159265358979 / cells;
}

TEST(SpotLight, FalloffIsOfFourthPower) {
  LightMaker maker;
  for (const auto& [angle, delta] :
       {std::pair(30.f, 5.f), std::pair(90.f, 60.f), std::pair(10.f, 10.f), std::pair(170.f, 100.f),
        std::pair(40.f, 0.f)}) {
    const auto light = maker.make(
        "spot", {{"coneangle", std::to_string(angle)}, {"conedeltaangle", std::to_string(delta)}});
    const double total = std::cos(static_cast<double>(radians(angle)));
    const double start = std::cos(static_cast<double>(radians(angle - delta)));
    const double expected = 2 * 3.14159265358979 * (1 - start + (start - total) / 5);
    EXPECT_NEAR(spotFlux(*light, 3), expected, 0.002 * expected + 1e-3) << angle << " " << delta;
    const double power = 2 * 3.14159265358979 * (1 - 0.5 * (start + total));
    EXPECT_NEAR(static_cast<double>(light->power(0).r), power, 1e-5 * power + 1e-6);
  }
}

TEST(SpotLight, EmitsWithinItsBounds) {
  LightMaker maker;
  const auto light = maker.make(
      "spot", {{"from", "0 0 0"}, {"to", "1 1 0"}, {"coneangle", "50"}, {"conedeltaangle", "20"}},
      Transform::rotate(40, {0, 0, 1}));
  const LightBounds b = *light->bounds(0);
  const float limit = std::acos(b.cosThetaO) + std::acos(b.cosThetaE);
  int lit = 0;
  for (int i = 0; i < 400; ++i) {
    const float a = static_cast<float>(i) * 2 * kPi / 400;
    const Vec3 w(std::cos(a), std::sin(a), 0);
    if (!light->sample(0, w, {0, 0})) continue;
    ++lit;
    EXPECT_LE(std::acos(std::min(dot(w, b.axis), 1.f)), limit + 1e-3f);
  }
  EXPECT_NEAR(lit, 400 * 100 / 360, 2);
}

TEST(SpotLight, AngleIsMeasuredInItsSpace) {
  LightMaker maker;
  const auto light = maker.make("spot", {{"coneangle", "46"}, {"conedeltaangle", "0"}},
                                Transform::scale({3, 1, 1}));
  EXPECT_TRUE(light->sample(0, {3, 0, 1.01f}, {0, 0}));
  EXPECT_FALSE(light->sample(0, {0, 3, 1.01f}, {0, 0}));
  EXPECT_EQ(light->bounds(0)->cosThetaO, -1) << "no cone in world space";
}

TEST(DistantLight, DirectionAndPower) {
  LightMaker maker;
  const auto light = maker.make("distant", {{"L", "3 3 3"}, {"from", "0 0 5"}, {"to", "0 0 1"}});
  light->prepare(Bounds3(Vec3(-1), Vec3(1)));
  const auto s = light->sample(0, {7, 8, 9}, {0.1f, 0.2f});
  ASSERT_TRUE(s);
  EXPECT_EQ(s->wi, Vec3(0, 0, 1));
  EXPECT_EQ(s->radiance.r, 3);
  EXPECT_EQ(s->pdf, 1);
  EXPECT_FLOAT_EQ(light->power(0).r, 3 * kPi * 3);
  const Vec3 slanted = normalize(Vec3(0, 1, 1));
  EXPECT_FLOAT_EQ(light->irradianceEstimate(slanted, false), 3 * slanted.z);
  EXPECT_EQ(light->irradianceEstimate(-slanted, false), 0);
  EXPECT_FLOAT_EQ(light->irradianceEstimate(-slanted, true), 3 * slanted.z);
  EXPECT_FALSE(light->bounds(0));
}

TEST(Lights, FaultyInput) {
  LightMaker maker;
  EXPECT_THROW(maker.make("spot", {{"from", "1 2 3"}, {"to", "1 2 3"}}), SceneError);
  EXPECT_THROW(maker.make("distant", {{"from", "1 2 3"}, {"to", "1 2 3"}}), SceneError);
  EXPECT_THROW(maker.make("spot", {}, Transform::scale({0, 1, 1})), SceneError);
  EXPECT_THROW(maker.make("point", {{"I", "1e30 1 1"}, {"scale", "1e30 1 1"}}), SceneError);
  EXPECT_THROW(maker.make("infinite", {{"mapname", "/no/such/file.exr"}}), std::exception);
  EXPECT_TRUE(maker.build.warnings.empty());
  const auto clamped = maker.make("point", {{"I", "1 -1 1"}});
  EXPECT_EQ(maker.build.warnings.size(), 1u);
  EXPECT_EQ(clamped->power(0).g, 0);
}

TEST(Lights, BlackOnesSendNothing) {
  LightMaker maker;
  for (const auto& plugin : lightRegistry().entries()) {
    const char* color = plugin.schema.find("I") ? "I" : "L";
    const auto light = maker.make(plugin.name, {{color, "0 0 0"}});
    light->prepare(Bounds3(Vec3(-1), Vec3(1)));
    EXPECT_TRUE(light->power(0).isBlack()) << plugin.name;
    EXPECT_FALSE(light->sample(0, {0, 0, 1}, {0.5f, 0.5f})) << plugin.name;
  }
}

}  // namespace
}  // namespace lampyris::test
