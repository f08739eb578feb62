// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "core/sampling.h"
#include "material_cases.h"
#include "materials/fresnel.h"
#include "materials/registry.h"
#include "support/statistics.h"

namespace lampyris::test {
namespace {

/// The mean weight of samples, of those with `flags` only.
Rgb albedo(const Bsdf& b, const Vec3& wo, uint8_t flags) {
  Rgb sum;
  constexpr uint64_t kDraws = 20'000;
  for (uint64_t i = 0; i < kDraws; ++i) {
    const auto s = b.sample(wo, uniform(31, i, 0), {uniform(31, i, 1), uniform(31, i, 2)});
    if (s && (s->flags & flags) == flags) sum += s->f * (b.absCosTheta(s->wi) / s->pdf);
  }
  return sum / static_cast<float>(kDraws);
}

TEST(Materials, AllAreRegistered) {
  const auto names = materialRegistry().names();
  const std::vector<std::string> expected = {
      "matte",       "plastic", "metal",  "mirror", "glass",   "uber",       "substrate",
      "translucent", "mix",     "disney", "hair",   "fourier", "subsurface", "kdsubsurface"};
  EXPECT_EQ(names, expected);
}

TEST(Materials, ConstantsNeedNoDifferentials) {
  EXPECT_FALSE(MaterialFixture("uber", {})->wantsDifferentials());
  EXPECT_TRUE(MaterialFixture("uber", {{"vroughness", "@half"}})->wantsDifferentials());
  EXPECT_TRUE(MaterialFixture("matte", {{"Kd", "@checks"}})->wantsDifferentials());
  EXPECT_TRUE(MaterialFixture("metal", {{"roughness", "@half"}})->wantsDifferentials());
  EXPECT_TRUE(MaterialFixture("mirror", {{"bumpmap", "@half"}})->wantsDifferentials());
  EXPECT_FALSE(MaterialFixture("mirror", {{"bumpmap", "0.5"}})->wantsDifferentials());
}

TEST(Materials, BumpMapsNeedDetail) {
  for (const auto& e : materialRegistry().entries()) {
    if (e.name == "mix" || e.name == "hair") continue;
    TestParameters::List parameters = neededParameters(e.name);
    EXPECT_EQ(MaterialFixture(e.name, parameters)->detail(), SurfaceDetail::Basic);
    parameters.emplace_back("bumpmap", "@half");
    EXPECT_EQ(MaterialFixture(e.name, parameters)->detail(), SurfaceDetail::Full);
  }
  const TestParameters::List bumpyFirst = {{"namedmaterial1", "bumpy"},
                                           {"namedmaterial2", "mirror"}};
  const TestParameters::List bumpySecond = {{"namedmaterial1", "mirror"},
                                            {"namedmaterial2", "bumpy"}};
  EXPECT_EQ(MaterialFixture("mix", bumpyFirst)->detail(), SurfaceDetail::Full);
  EXPECT_EQ(MaterialFixture("mix", bumpySecond)->detail(), SurfaceDetail::Basic);
  EXPECT_TRUE(MaterialFixture("mix", bumpySecond)->wantsDifferentials());
}

TEST(Materials, BlackLobesAreSkipped) {
  const auto lobes = [](const std::string& plugin, const TestParameters::List& parameters) {
    const MaterialFixture m(plugin, parameters);
    Bsdf b;
    m.evaluate(b);
    return b.lobeCount();
  };
  EXPECT_EQ(lobes("matte", {{"Kd", "0 0 0"}}), 0u);
  EXPECT_EQ(lobes("matte", {{"Kd", "-1 -2 -3"}}), 0u);
  EXPECT_EQ(lobes("plastic", {}), 2u);
  EXPECT_EQ(lobes("plastic", {{"Ks", "0 0 0"}}), 1u);
  EXPECT_EQ(lobes("uber", {}), 2u);
  EXPECT_EQ(lobes("uber", {{"Kr", "1 1 1"}, {"Kt", "1 1 1"}, {"opacity", ".5 .5 .5"}}), 4u);
  EXPECT_EQ(lobes("uber", {{"opacity", "0 0 0"}}), 1u);
  EXPECT_EQ(lobes("glass", {{"Kr", "0 0 0"}, {"Kt", "0 0 0"}}), 0u);
  EXPECT_EQ(lobes("translucent", {}), 3u);
  EXPECT_EQ(lobes("translucent", {{"reflect", "0 0 0"}, {"transmit", "0 0 0"}}), 0u);
  EXPECT_EQ(lobes("mirror", {{"Kr", "0 0 0"}}), 0u);
}

TEST(Materials, TexturesThatAreNoNumbersScatterNothingOdd) {
  for (const auto& e : materialRegistry().entries()) {
    for (const auto& d : e.schema.declarations()) {
      const bool colour = d.target == TargetType::RgbInput;
      if (!colour && d.target != TargetType::FloatInput) continue;
      TestParameters::List parameters = neededParameters(e.name);
      parameters.emplace_back(d.name, colour ? "@nan colour" : "@nan");
      const MaterialFixture m(e.name, parameters);
      Bsdf b;
      m.evaluate(b);
      const Vec3 wo = outgoing(b, 40);
      for (uint64_t i = 0; i < 200; ++i) {
        const auto s = b.sample(wo, uniform(3, i, 0), {uniform(3, i, 1), uniform(3, i, 2)});
        if (!s) continue;
        ASSERT_TRUE(s->f.isFinite() && std::isfinite(s->pdf)) << e.name << " " << d.name;
        ASSERT_TRUE(s->f.r >= 0 && s->f.g >= 0 && s->f.b >= 0);
        ASSERT_TRUE(isFinite(s->wi));
      }
    }
  }
}

TEST(Materials, RefusesNumbersWithoutMeaning) {
  EXPECT_THROW(MaterialFixture("glass", {{"eta", "0"}}), SceneError);
  EXPECT_THROW(MaterialFixture("uber", {{"index", "-1.5"}}), SceneError);
  EXPECT_THROW(MaterialFixture("plastic", {{"roughness", "-0.1"}}), SceneError);
  EXPECT_THROW(MaterialFixture("matte", {{"Kd", "@unknown"}}), SceneError);
}

TEST(Materials, MirrorAndGlassAreWhite) {
  for (const auto& [plugin, parameters] :
       {std::pair<std::string, TestParameters::List>("mirror", {{"Kr", "1 1 1"}}),
        {"glass", {}},
        {"matte", {{"Kd", "1 1 1"}}}}) {
    const MaterialFixture m(plugin, parameters);
    Bsdf b;
    m.evaluate(b);
    for (const float angle : {0.f, 60.f, 120.f, 179.f}) {
      const Vec3 wo = outgoing(b, angle);
      for (uint64_t i = 0; i < 200; ++i) {
        const auto s = b.sample(wo, uniform(3, i, 0), {uniform(3, i, 1), uniform(3, i, 2)});
        ASSERT_TRUE(s);
        EXPECT_NEAR(s->f.r * b.absCosTheta(s->wi) / s->pdf * s->eta * s->eta, 1, 1e-4f) << plugin;
      }
    }
  }
}

TEST(Materials, RoughMetalReflectsAsFresnelSays) {
  const MaterialFixture m("metal", {{"roughness", "0"}, {"remaproughness", "false"}});
  Bsdf b;
  m.evaluate(b);
  const Rgb r = albedo(b, outgoing(b, 60), kReflection);
  EXPECT_NEAR(r.r, fresnelConductor(0.5f, 0.19999069f, 3.90463543f), 2e-3f);
  EXPECT_NEAR(r.g, fresnelConductor(0.5f, 0.92208463f, 2.44763327f), 2e-3f);
  EXPECT_NEAR(r.b, fresnelConductor(0.5f, 1.09987593f, 2.13765264f), 2e-3f);
}

TEST(Materials, PlasticReflectsTotallyBeyondTheCriticalAngle) {
  const MaterialFixture m("plastic",
                          {{"Kd", "0 0 0"}, {"roughness", "0"}, {"remaproughness", "false"}});
  Bsdf b;
  m.evaluate(b);
  EXPECT_NEAR(albedo(b, outgoing(b, 60), kReflection).r, 0.25f, 2e-3f);
  EXPECT_NEAR(albedo(b, outgoing(b, 1), kReflection).r, 0.25f * 0.04f, 1e-3f);
}

TEST(Materials, UberOpacityLetsLightPassStraightOn) {
  const MaterialFixture m("uber",
                          {{"opacity", "0.25 0.5 1"}, {"Ks", "0 0 0"}, {"Kd", "0.8 0.8 0.8"}});
  Bsdf b;
  m.evaluate(b);
  const Vec3 wo = outgoing(b, 70);
  const Rgb passed = albedo(b, wo, kTransmission | kSpecular), diffuse = albedo(b, wo, kDiffuse);
  EXPECT_NEAR(passed.r, 0.75f, 0.03f);
  EXPECT_NEAR(passed.g, 0.5f, 0.02f);
  EXPECT_EQ(passed.b, 0);
  EXPECT_NEAR(diffuse.r, 0.2f, 0.01f);
  EXPECT_NEAR(diffuse.g, 0.4f, 0.02f);
  EXPECT_NEAR(diffuse.b, 0.8f, 0.03f);
  for (uint64_t i = 0; i < 100; ++i) {
    const auto s = b.sample(wo, uniform(3, i, 0), {0.5f, 0.5f});
    if (s && s->isTransmission()) {
      EXPECT_NEAR(length(s->wi + wo), 0, 1e-6f);
      EXPECT_EQ(s->eta, 1);
    }
  }
}

TEST(Materials, UberReflectsAndRefractsSpecularly) {
  const MaterialFixture m(
      "uber", {{"Kd", "0 0 0"}, {"Ks", "0 0 0"}, {"Kr", "1 1 1"}, {"Kt", "0.5 0.5 0.5"}});
  Bsdf b;
  m.evaluate(b);
  EXPECT_TRUE(b.isSpecular());
  const Vec3 wo = outgoing(b, 75);
  const float fresnel = fresnelDielectric(std::cos(radians(75)), 1.5f);
  EXPECT_NEAR(albedo(b, wo, kReflection | kSpecular).r, fresnel, 0.01f);
  EXPECT_NEAR(albedo(b, wo, kTransmission | kSpecular).r, 0.5f * (1 - fresnel) / 2.25f, 0.01f);
}

TEST(Materials, RoughnessTurnsWithTheTangent) {
  const MaterialFixture m("metal", {{"uroughness", "0.001"}, {"vroughness", "0.8"}});
  Bsdf b;
  m.evaluate(b);
  const Frame& f = b.frame();
  const Vec3 alongU = normalize(f.z + 0.5f * f.x), alongV = normalize(f.z + 0.5f * f.y);
  EXPECT_GT(b.f(f.z, alongV).g, 3 * b.f(f.z, alongU).g);
}

TEST(Mix, AddsSharesOfBoth) {
  const MaterialFixture mix(
      "mix", {{"namedmaterial1", "diffuse"}, {"namedmaterial2", "coat"}, {"amount", "0.25 0.5 2"}});
  const MaterialFixture diffuse("matte", {{"Kd", "0.7 0.7 0.2"}});
  const MaterialFixture coat("substrate", {{"uroughness", "0.3"}});
  Bsdf m, d, c;
  mix.evaluate(m), diffuse.evaluate(d), coat.evaluate(c);
  const Vec3 wo = outgoing(m, 40), wi = outgoing(m, 70, 200);
  const Rgb f = m.f(wo, wi), fd = d.f(wo, wi), fc = c.f(wo, wi);
  EXPECT_FLOAT_EQ(f.r, 0.25f * fd.r + 0.75f * fc.r);
  EXPECT_FLOAT_EQ(f.g, 0.5f * fd.g + 0.5f * fc.g);
  EXPECT_FLOAT_EQ(f.b, 2 * fd.b) << "the rest is clamped at 0";
}

TEST(Mix, MayBeNested) {
  MaterialFixture inner("mix", {{"namedmaterial1", "diffuse"}, {"namedmaterial2", "coat"}});
  const auto& plugin = materialRegistry().get("mix", {});
  inner.build().materials.add("inner", &*inner);
  const TestParameters p(
      plugin.schema,
      {{"namedmaterial1", "inner"}, {"namedmaterial2", "inner"}, {"amount", "0.3 0.3 0.3"}});
  const auto outer = plugin.create(p.set(), inner.build().materialContext());
  SurfaceInteraction at = tiltedSurface();
  Bsdf a, b;
  outer->evaluate(at, a);
  inner.evaluate(b);
  const Vec3 wo = outgoing(a, 40), wi = outgoing(a, 70, 200);
  EXPECT_EQ(a.lobeCount(), 4u);
  EXPECT_NEAR(a.f(wo, wi).g, b.f(wo, wi).g, 1e-5f * b.f(wo, wi).g);
}

TEST(Mix, RefusesWhatCannotBeMixed) {
  const auto mix = [](const std::string& a, const std::string& b) {
    return MaterialFixture("mix", {{"namedmaterial1", a}, {"namedmaterial2", b}});
  };
  EXPECT_THROW(mix("diffuse", "unknown"), SceneError);
  EXPECT_THROW(mix("diffuse", "nothing"), SceneError);
  EXPECT_THROW(MaterialFixture("mix", {{"namedmaterial1", "diffuse"}}), SceneError);
  MaterialFixture full("mix", {{"namedmaterial1", "everything"}, {"namedmaterial2", "everything"}});
  full.build().materials.add("full", &*full);
  const auto& plugin = materialRegistry().get("mix", {});
  const TestParameters p(plugin.schema,
                         {{"namedmaterial1", "full"}, {"namedmaterial2", "diffuse"}});
  EXPECT_THROW(plugin.create(p.set(), full.build().materialContext()), SceneError);
}

}  // namespace
}  // namespace lampyris::test
