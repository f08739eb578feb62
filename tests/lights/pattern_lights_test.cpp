// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "accelerators/light_bvh_importance.h"
#include "core/error.h"
#include "core/frame.h"
#include "core/sampling.h"
#include "light_maker.h"
#include "support/statistics.h"

namespace lampyris::test {
namespace {

std::string writePattern(const std::string& name, int width, int height,
                         const std::function<Rgb(int, int)>& texel) {
  Image image(width, height, 3);
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) image.setRgb(x, y, texel(x, y));
  std::string path = testing::TempDir() + name;
  writeImageFile(path, image);
  return path;
}

/// Texel (x, y) is 1 + x + 10 y.
std::string writeNumbers(const std::string& name, int width, int height) {
  return writePattern(name, width, height,
                      [](int x, int y) { return Rgb(static_cast<float>(1 + x + 10 * y)); });
}

/// Radiant intensity towards `w` of a light at the origin.
float intensity(const Light& light, const Vec3& w) {
  const auto s = light.sample(0, 3.f * w, {0.5f, 0.5f});
  return s ? s->radiance.luminance() * 9 * lengthSquared(w) : 0;
}

Vec3 randomDirection(uint64_t i) {
  return sampleUniformSphere({uniform(8, i, 0), uniform(8, i, 1)});
}

const std::vector<Transform>& transforms() {
  static const std::vector<Transform> all{
      Transform(), Transform::rotate(70, {1, 2, 3}), Transform::scale({1, 2, 0.3f}),
      Transform::rotate(30, {0, 1, 1}) * Transform::scale({-1e3f, 1e3f, 1e3f})};
  return all;
}

TEST(ProjectionLight, ImageConventions) {
  LightMaker maker;
  const auto light = maker.make(
      "projection", {{"mapname", writeNumbers("slide.pfm", 4, 2)}, {"fov", "90"}, {"I", "2 2 2"}});
  // The shorter side spans the field of view: x in [−2, 2], y in [−1, 1] at z = 1.
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 4; ++x) {
      const Vec3 d(static_cast<float>(x) - 1.5f, static_cast<float>(y) - 0.5f, 1);
      const auto s = light->sample(0, d, {0.5f, 0.5f});
      ASSERT_TRUE(s);
      EXPECT_NEAR(s->radiance.r * lengthSquared(d), 2 * static_cast<float>(1 + x + 10 * y), 1e-3);
      EXPECT_NEAR(distance(s->wi, -normalize(d)), 0, 1e-6);
      EXPECT_EQ(s->pdf, 1);
      EXPECT_EQ(s->n, Vec3(0));
    }
  EXPECT_TRUE(light->sample(0, {1.99f, 0.99f, 1}, {0, 0}));
  EXPECT_FALSE(light->sample(0, {2.01f, 0, 1}, {0, 0}));
  EXPECT_FALSE(light->sample(0, {0, 1.01f, 1}, {0, 0}));
  EXPECT_FALSE(light->sample(0, {0, 0, -1}, {0, 0}));
  EXPECT_FALSE(light->sample(0, Vec3(0), {0, 0}));
  // pbrt-v3: the mean of the texels times the cone that holds the image.
  EXPECT_NEAR(light->power(0).r, 2 * 7.5f * 2 * kPi * (1 - 1 / std::sqrt(6.f)), 1e-3f);
}

TEST(GoniometricLight, ImageConventions) {
  LightMaker maker;
  const auto light =
      maker.make("goniometric", {{"mapname", writeNumbers("gonio.pfm", 8, 4)}, {"scale", "3 3 3"}});
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 8; ++x) {
      const float theta = (static_cast<float>(y) + 0.5f) * kPi / 4;
      const float phi = (static_cast<float>(x) + 0.5f) * kPi / 4;
      // y is up, φ runs from +x to +z.
      const Vec3 d(std::sin(theta) * std::cos(phi), std::cos(theta),
                   std::sin(theta) * std::sin(phi));
      const auto s = light->sample(0, 2.f * d, {0.5f, 0.5f});
      ASSERT_TRUE(s);
      EXPECT_NEAR(s->radiance.r * 4, 3 * static_cast<float>(1 + x + 10 * y), 2e-3);
    }
  EXPECT_NEAR(light->power(0).r, 3 * 19.5f * 4 * kPi, 1e-2f);
  EXPECT_EQ(light->bounds(0)->cosThetaO, -1);
}

/// Their LightBounds have the flux: mean intensity over the directions that are lit.
TEST(PatternLights, IntensityIsTheMean) {
  const std::string map = writePattern("flux.pfm", 16, 8, [](int x, int y) {
    const auto at = static_cast<uint64_t>(16 * y + x);
    return Rgb(uniform(4, at, 0), uniform(4, at, 1), uniform(4, at, 2) + 0.1f);
  });
  LightMaker maker;
  for (const char* name : {"projection", "goniometric"})
    for (const Transform& t : transforms()) {
      const auto light = maker.make(name, {{"mapname", map}, {"I", "1 2 3"}}, t);
      const auto plain = maker.make(name, {}, t);
      double sum = 0, lit = 0;
      const int cells = 500;
      for (int i = 0; i < cells; ++i)
        for (int j = 0; j < 2 * cells; ++j) {
          const float c = 1 - 2 * (static_cast<float>(i) + 0.5f) / cells;
          const Vec3 w = sphericalDirection(std::sqrt(1 - c * c), c,
                                            kPi * (static_cast<float>(j) + 0.5f) / cells);
          const float value = intensity(*light, w);
          sum += static_cast<double>(value);
          lit += value > 0 ? 1 : 0;
        }
      EXPECT_NEAR(static_cast<double>(light->bounds(0)->intensity), sum / lit, 0.02 * sum / lit)
          << name;
      EXPECT_NEAR(plain->bounds(0)->intensity, 1, 1e-5) << name;
    }
}

TEST(PatternLights, BoundsHoldAllThatIsLit) {
  const std::string map = writePattern("dot.pfm", 12, 8, [](int x, int y) {
    return Rgb(x == 11 && y == 7 ? 1.f : 0.f);  // in a corner, where a cone is tight
  });
  LightMaker maker;
  for (const char* name : {"projection", "goniometric"})
    for (const char* fov : {"0.5", "40", "120", "179"})
      for (const bool plain : {false, true})
        for (const Transform& t : transforms()) {
          TestParameters::List list;
          if (!plain) list.push_back({"mapname", map});
          if (std::string(name) == "projection") list.push_back({"fov", fov});
          const auto light = maker.make(name, list, t);
          const LightBounds b = *light->bounds(0);
          EXPECT_FALSE(light->power(0).isBlack());
          const LinearLightBVHNode node(b.box, EmissionCone::of(b), b.intensity, true, 0);
          int lit = 0;
          for (uint64_t i = 0; i < 2000; ++i) {
            // Towards the image's corners, or anywhere.
            const Vec2 half = std::tan(radians(std::stof(fov)) / 2) * Vec2(plain ? 1 : 1.5f, 1);
            const auto nearEdge = [&](uint32_t d) {
              return (uniform(2, i, d) < 0.5f ? -1.f : 1.f) * (1 - 0.1f * uniform(2, i, d + 1));
            };
            const Vec3 local =
                i % 2 ? randomDirection(i) : Vec3(Vec2(nearEdge(0), nearEdge(2)) * half, 1);
            const Vec3 w = normalize(t.vector(local));
            if (!(intensity(*light, w) > 0)) continue;
            ++lit;
            EXPECT_GT(LightReceiver(3.f * w, 0.f).importance(node), 0) << name << " " << fov;
          }
          EXPECT_GT(lit, 10) << name << " " << fov;
        }
}

TEST(PatternLights, ConesAreTight) {
  LightMaker maker;
  const auto light = maker.make("projection", {{"fov", "60"}}, Transform::scale(Vec3(7)));
  const LightBounds b = *light->bounds(0);
  EXPECT_EQ(b.axis, Vec3(0, 0, 1));
  EXPECT_NEAR(b.cosThetaO, 1 / std::sqrt(1 + 2 * sqr(std::tan(radians(30)))), 1e-5);
  EXPECT_EQ(b.cosThetaE, 1);
  EXPECT_EQ(b.box.extent(), Vec3(0));
}

TEST(PatternLights, FaultyInput) {
  LightMaker maker;
  for (const char* name : {"projection", "goniometric"}) {
    EXPECT_THROW(maker.make(name, {{"mapname", "/no/such/file.png"}}), SceneError);
    EXPECT_THROW(maker.make(name, {}, Transform::scale({0, 1, 1})), SceneError);
    const auto bad = writePattern(
        "bad.pfm", 2, 2, [](int x, int) { return x ? Rgb(std::nanf(""), -1, kInfinity) : Rgb(1); });
    const size_t before = maker.build.warnings.size();
    const auto light = maker.make(name, {{"mapname", bad}});
    EXPECT_GE(maker.build.warnings.size(), before);
    for (uint64_t i = 0; i < 100; ++i) {
      const float v = intensity(*light, randomDirection(i));
      EXPECT_TRUE(v >= 0 && v <= 1.001f);
    }
  }
  EXPECT_EQ(maker.build.warnings.size(), 1u) << "the file is read once";
  EXPECT_THROW(maker.make("projection", {{"fov", "0"}}), SceneError);
  EXPECT_THROW(maker.make("projection", {{"fov", "180"}}), SceneError);
}

}  // namespace
}  // namespace lampyris::test
