// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "textures/texture_test_support.h"

namespace lampyris {
namespace {

using namespace test;

TEST(Textures, Registered) {
  for (const char* name : {"constant", "scale", "mix", "bilerp", "imagemap", "checkerboard"}) {
    EXPECT_TRUE(floatTextureRegistry().find(name)) << name;
    EXPECT_TRUE(spectrumTextureRegistry().find(name)) << name;
  }
  EXPECT_TRUE(spectrumTextureRegistry().find("uv"));
  EXPECT_FALSE(floatTextureRegistry().find("uv"));
}

TEST(Textures, Constant) {
  TextureBench bench;
  EXPECT_EQ(bench.makeFloat("constant")->evaluate({}), 1);
  EXPECT_EQ(bench.makeSpectrum("constant")->evaluate({}), Rgb(1));
  EXPECT_EQ(bench.makeFloat("constant", Parameters().number("value", 3))->evaluate({}), 3);
  EXPECT_EQ(
      bench.makeSpectrum("constant", Parameters().add("value", ParameterType::Rgb, {1, 2, 3}))
          ->evaluate({}),
      Rgb(1, 2, 3));
}

TEST(Textures, ScaleOfTextures) {
  TextureBench bench;
  EXPECT_EQ(bench.makeFloat("scale")->evaluate({}), 1);
  EXPECT_EQ(bench.makeSpectrum("scale")->evaluate({}), Rgb(1));
  const auto uv = bench.makeSpectrum("uv");
  bench.named.spectra["uv"] = uv.get();
  const auto product = bench.makeSpectrum("scale", Parameters()
                                                       .word("tex1", "uv", ParameterType::Texture)
                                                       .add("tex2", ParameterType::Rgb, {2, 3, 4}));
  const Rgb c = product->evaluate(atUv(0.25f, 0.5f));
  EXPECT_FLOAT_EQ(c.r, 0.5f);
  EXPECT_FLOAT_EQ(c.g, 1.5f);
  EXPECT_EQ(c.b, 0);
}

TEST(Textures, MixOfTextures) {
  TextureBench bench;
  EXPECT_EQ(bench.makeFloat("mix")->evaluate({}), 0.5f);
  EXPECT_EQ(bench.makeSpectrum("mix")->evaluate({}), Rgb(0.5f));
  const auto amount = bench.makeFloat("bilerp", Parameters().number("v01", 0).number("v10", 1));
  bench.named.floats["amount"] = amount.get();
  const auto mix = bench.makeSpectrum("mix", Parameters()
                                                 .add("tex1", ParameterType::Rgb, {1, 0, 0})
                                                 .add("tex2", ParameterType::Rgb, {0, 0, 2})
                                                 .word("amount", "amount", ParameterType::Texture));
  const Rgb c = mix->evaluate(atUv(0.25f, 0.9f));
  EXPECT_FLOAT_EQ(c.r, 0.75f);
  EXPECT_FLOAT_EQ(c.b, 0.5f);
}

TEST(Textures, BilerpCornersAndCentre) {
  TextureBench bench;
  const auto t = bench.makeFloat(
      "bilerp", Parameters().number("v00", 1).number("v01", 2).number("v10", 4).number("v11", 8));
  EXPECT_EQ(t->evaluate(atUv(0, 0)), 1);
  EXPECT_EQ(t->evaluate(atUv(0, 1)), 2);
  EXPECT_EQ(t->evaluate(atUv(1, 0)), 4);
  EXPECT_EQ(t->evaluate(atUv(1, 1)), 8);
  EXPECT_FLOAT_EQ(t->evaluate(atUv(0.5f, 0.5f)), 3.75f);
  // Defaults: v.
  EXPECT_FLOAT_EQ(bench.makeFloat("bilerp")->evaluate(atUv(0.3f, 0.7f)), 0.7f);
}

TEST(Textures, UvIsPeriodic) {
  TextureBench bench;
  const auto t = bench.makeSpectrum("uv", Parameters().number("uscale", 2).number("vdelta", -3));
  const Rgb c = t->evaluate(atUv(0.75f, 0.5f));
  EXPECT_FLOAT_EQ(c.r, 0.5f);
  EXPECT_FLOAT_EQ(c.g, 0.5f);
  EXPECT_EQ(c.b, 0);
}

TEST(Textures, WrongParametersAreSceneErrors) {
  TextureBench bench;
  EXPECT_THROW(bench.makeFloat("checkerboard", Parameters().integer("dimension", 4)), SceneError);
  EXPECT_THROW(bench.makeFloat("checkerboard", Parameters().word("aamode", "box")), SceneError);
  EXPECT_THROW(bench.makeFloat("bilerp", Parameters().word("mapping", "cubic")), SceneError);
  EXPECT_THROW(bench.makeSpectrum("uv", Parameters().add("v1", ParameterType::Float, {1, 0, 0})),
               SceneError);
}

float checkerAt(const FloatTexture& t, float u, float v) { return t.evaluate(atUv(u, v)); }

TEST(Checkerboard, Parity) {
  TextureBench bench;
  for (const char* mode : {"none", "closedform"}) {
    const auto t = bench.makeFloat("checkerboard", Parameters().word("aamode", mode));
    EXPECT_EQ(checkerAt(*t, 0.5f, 0.5f), 1);
    EXPECT_EQ(checkerAt(*t, 1.5f, 0.5f), 0);
    EXPECT_EQ(checkerAt(*t, 1.5f, 1.5f), 1);
    EXPECT_EQ(checkerAt(*t, -0.5f, 0.5f), 0);
    EXPECT_EQ(checkerAt(*t, -0.5f, -1.5f), 0);
    EXPECT_EQ(checkerAt(*t, -0.5f, -0.5f), 1);
    // Beyond the integers: any value, but no fault.
    const float far = checkerAt(*t, 1e30f, -1e30f);
    EXPECT_TRUE(far == 0 || far == 1);
  }
}

TEST(Checkerboard, ClosedFormIsTheBoxFilteredPattern) {
  TextureBench bench;
  const auto filtered = bench.makeFloat("checkerboard");
  const auto point = bench.makeFloat("checkerboard", Parameters().word("aamode", "none"));
  for (const Vec2 at : {Vec2(0.9f, 0.4f), Vec2(-2.05f, 3.1f), Vec2(7.3f, -1.02f)})
    for (const Vec2 r : {Vec2(0.2f, 0.3f), Vec2(0.9f, 0.01f), Vec2(0.6f, 0.95f)}) {
      SurfaceInteraction s = atUv(at.x, at.y);
      s.duvdx = {-r.x, 0.f};
      s.duvdy = {r.x / 2, r.y};
      double sum = 0;
      constexpr int kCells = 400;
      for (int j = 0; j < kCells; ++j)
        for (int i = 0; i < kCells; ++i)
          sum += static_cast<double>(
              checkerAt(*point, at.x + r.x * (2 * (static_cast<float>(i) + 0.5f) / kCells - 1),
                        at.y + r.y * (2 * (static_cast<float>(j) + 0.5f) / kCells - 1)));
      EXPECT_NEAR(filtered->evaluate(s), sum / (kCells * kCells), 0.01);
    }
}

TEST(Checkerboard, WideFootprintsAreGrey) {
  TextureBench bench;
  const auto t = bench.makeFloat("checkerboard", Parameters().number("tex1", 3).number("tex2", 1));
  SurfaceInteraction s = atUv(0.3f, 0.2f);
  s.duvdx = {1.01f, 0};
  EXPECT_EQ(t->evaluate(s), 2);
  s.duvdx = {1e8f, -1e8f};
  s.duvdy = {1e8f, 1e8f};
  EXPECT_EQ(t->evaluate(s), 2);
  // A footprint along one axis only, over an edge: no division by zero.
  s = atUv(1, 0.5f);
  s.duvdx = {0.25f, 0};
  EXPECT_EQ(t->evaluate(s), 2);
}

TEST(Checkerboard, ThreeDimensions) {
  TextureBench bench;
  const auto t = bench.makeFloat("checkerboard", Parameters().integer("dimension", 3));
  EXPECT_EQ(t->evaluate(atPoint({0.5f, 0.5f, 0.5f})), 1);
  EXPECT_EQ(t->evaluate(atPoint({1.5f, 0.5f, 0.5f})), 0);
  EXPECT_EQ(t->evaluate(atPoint({1.5f, -0.5f, 0.5f})), 1);
  EXPECT_EQ(t->evaluate(atPoint({1.5f, -0.5f, 2.5f})), 1);
  EXPECT_EQ(t->evaluate(atPoint({-0.5f, -0.5f, -0.5f})), 0);
  // pbrt-v3's convention: the texture's own transform, not its inverse, is applied.
  bench.textureToWorld = Transform::scale(Vec3(2));
  const auto scaled = bench.makeFloat("checkerboard", Parameters().integer("dimension", 3));
  EXPECT_EQ(scaled->evaluate(atPoint({0.75f, 0.25f, 0.25f})), 0);
}

}  // namespace
}  // namespace lampyris
