// SPDX-License-Identifier: Apache-2.0
#include "base/bsdf.h"

#include <gtest/gtest.h>

#include "core/sampling.h"
#include "support/statistics.h"

namespace lampyris::test {
namespace {

/// Diffuse on the side of wo, or on the other one; its albedo can lie.
class Diffuse final : public Lobe {
 public:
  Diffuse(int side, float reflectance, float claimedAlbedo)
      : Lobe(static_cast<uint8_t>(side | kDiffuse)), claimed_(claimedAlbedo) {
    scale = Rgb(reflectance);
  }
  Rgb f(const Vec3&, const Vec3&) const override { return scale * kInvPi; }
  float pdf(const Vec3& wo, const Vec3& wi) const override {
    const bool same = wo.z * wi.z > 0;
    return same == bool(flags & kReflection) ? std::abs(wi.z) * kInvPi : 0;
  }
  std::optional<LobeSample> sample(const Vec3& wo, float, const Vec2& u) const override {
    Vec3 wi = sampleCosineHemisphere(u);
    if ((wo.z > 0) != bool(flags & kReflection)) wi.z = -wi.z;
    return LobeSample{wi, f(wo, wi), std::abs(wi.z) * kInvPi, flags, 1};
  }
  float albedo(const Vec3&) const override { return claimed_; }

 private:
  float claimed_;
};

/// A mirror that hands the remapped `uc` out as eta.
class Delta final : public Lobe {
 public:
  explicit Delta(float reflectance) : Lobe(kReflection | kSpecular) { scale = Rgb(reflectance); }
  Rgb f(const Vec3&, const Vec3&) const override { return {}; }
  float pdf(const Vec3&, const Vec3&) const override { return 0; }
  std::optional<LobeSample> sample(const Vec3& wo, float uc, const Vec2&) const override {
    return LobeSample{{-wo.x, -wo.y, wo.z}, scale / std::abs(wo.z), 1, flags, uc};
  }
  float albedo(const Vec3&) const override { return scale.r; }
};

SurfaceInteraction upward() { return {}; }
const Vec3 kWo = normalize(Vec3(1, 2, 3));

TEST(Bsdf, EmptyScattersNothing) {
  Bsdf b;
  b.reset(upward());
  EXPECT_TRUE(b.empty());
  EXPECT_TRUE(b.isSpecular());
  EXPECT_FALSE(b.sample(kWo, 0.5f, {0.5f, 0.5f}));
  EXPECT_TRUE(b.f(kWo, kWo).isBlack());
  EXPECT_EQ(b.pdf(kWo, kWo), 0);
}

TEST(Bsdf, ResetRemovesLobesAndFlags) {
  Bsdf b;
  b.reset(upward());
  b.add<Delta>(1.f);
  EXPECT_TRUE(b.isSpecular());
  b.reset(upward());
  EXPECT_TRUE(b.empty());
  EXPECT_EQ(b.flags(), 0);
  b.add<Diffuse>(kReflection, 0.5f, 0.5f);
  EXPECT_FALSE(b.isSpecular());
  EXPECT_TRUE(b.isDiffuse());
  EXPECT_FALSE(b.transmits());
}

void expectOrthonormal(const Frame& f) {
  EXPECT_NEAR(length(f.x), 1, 1e-5f);
  EXPECT_NEAR(length(f.y), 1, 1e-5f);
  EXPECT_NEAR(length(f.z), 1, 1e-5f);
  EXPECT_NEAR(dot(f.x, f.z), 0, 1e-5f);
  EXPECT_NEAR(dot(cross(f.x, f.y), f.z), 1, 1e-5f);
}

TEST(Bsdf, FrameFollowsTheTangentAtAnyScale) {
  for (const float scale : {1e-30f, 1e-18f, 1e-4f, 1.f, 1e4f, 1e18f, 1e30f}) {
    SurfaceInteraction at;
    at.shading.n = normalize(Vec3(1, 1, 2));
    at.shading.dpdu = Vec3(3, 1, 0) * scale;
    Bsdf b;
    b.reset(at);
    expectOrthonormal(b.frame());
    EXPECT_EQ(b.frame().z, at.shading.n);
    EXPECT_GT(dot(b.frame().x, normalize(at.shading.dpdu)), 0.7f) << scale;
    EXPECT_NEAR(dot(b.frame().y, at.shading.dpdu / scale), 0, 1e-5f) << scale;
  }
}

TEST(Bsdf, FrameSurvivesDegenerateTangents) {
  const Vec3 n = normalize(Vec3(1, -1, 2));
  const float nan = std::numeric_limits<float>::quiet_NaN();
  for (const Vec3& dpdu : {Vec3(0), 5.f * n, -1e-20f * n, Vec3(nan), Vec3(kInfinity, 0, 0),
                           1e-3f * n + Vec3(1e-8f, 0, 0), n + Vec3(1e-3f, 0, 0)}) {
    SurfaceInteraction at;
    at.n = at.shading.n = n;
    at.shading.dpdu = dpdu;
    Bsdf b;
    b.reset(at);
    expectOrthonormal(b.frame());
  }
  SurfaceInteraction at;
  at.n = n;
  at.shading.n = Vec3(0);
  Bsdf b;
  b.reset(at);
  EXPECT_EQ(b.frame().z, n);
}

TEST(Bsdf, TheGeometricNormalTellsReflectionFromTransmission) {
  SurfaceInteraction at;
  at.n = Vec3(0, 0, 1);
  at.shading.n = normalize(Vec3(1, 0, 1));
  const Vec3 wo = normalize(Vec3(0.2f, 0, 1));
  const Vec3 belowShading = normalize(Vec3(-1, 0, 0.5f)),
             belowSurface = normalize(Vec3(1, 0, -0.5f));
  ASSERT_LT(dot(belowShading, at.shading.n), 0);
  ASSERT_GT(dot(belowSurface, at.shading.n), 0);
  Bsdf b;
  b.reset(at);
  b.add<Diffuse>(kReflection, 0.5f, 0.5f);
  EXPECT_FLOAT_EQ(b.f(wo, belowShading).r, 0.5f * kInvPi);
  EXPECT_TRUE(b.f(wo, belowSurface).isBlack());
  b.reset(at);
  b.add<Diffuse>(kTransmission, 0.25f, 0.5f);
  EXPECT_TRUE(b.f(wo, belowShading).isBlack());
  EXPECT_FLOAT_EQ(b.f(wo, belowSurface).r, 0.25f * kInvPi);
  b.add<Diffuse>(kReflection, 0.5f, 0.5f);
  EXPECT_FLOAT_EQ(b.f(wo, belowShading).r, 0.5f * kInvPi);
  EXPECT_FLOAT_EQ(b.f(wo, belowSurface).r, 0.25f * kInvPi);
  b.reset(at);
  b.add<Diffuse>(kReflection | kTransmission, 0.5f, 0.5f);
  EXPECT_TRUE(b.f(wo, belowShading).isBlack()) << "it cannot know which of both it is";
  EXPECT_FALSE(b.f(wo, wo).isBlack());
}

TEST(Bsdf, NeverSamplesLightThroughTheSurface) {
  SurfaceInteraction at;
  at.shading.n = normalize(Vec3(1, 0, 0.3f));
  const Vec3 wo = normalize(Vec3(0.2f, 0, 1));
  for (const int lobes : {1, 2}) {
    Bsdf b;
    b.reset(at);
    for (int i = 0; i < lobes; ++i) b.add<Diffuse>(kReflection, 0.5f, 0.5f);
    int drawn = 0;
    for (uint64_t i = 0; i < 1000; ++i) {
      const auto s = b.sample(wo, uniform(1, i, 0), {uniform(1, i, 1), uniform(1, i, 2)});
      if (!s) continue;
      ++drawn;
      EXPECT_GT(s->wi.z, 0);
    }
    EXPECT_GT(drawn, 100);
    EXPECT_LT(drawn, 950);
  }
}

TEST(Bsdf, MixtureIsUnbiasedThoughAlbedosLie) {
  Bsdf b;
  b.reset(upward());
  b.add<Diffuse>(kReflection, 0.5f, 1e-9f);
  b.add<Diffuse>(kTransmission, 0.25f, 0.75f);
  std::vector<double> reflected, transmitted;
  for (uint64_t i = 0; i < 400'000; ++i) {
    const auto s = b.sample(kWo, uniform(2, i, 0), {uniform(2, i, 1), uniform(2, i, 2)});
    ASSERT_TRUE(s);
    EXPECT_FLOAT_EQ(s->pdf, b.pdf(kWo, s->wi));
    const double w = static_cast<double>(s->f.r * b.absCosTheta(s->wi) / s->pdf);
    ASSERT_LT(w, 1000) << "the floor bounds weights";
    reflected.push_back(s->isTransmission() ? 0 : w);
    transmitted.push_back(s->isTransmission() ? w : 0);
  }
  EXPECT_EQ(meanTest(reflected, 0.5), "");
  EXPECT_EQ(meanTest(transmitted, 0.25), "");
}

TEST(Bsdf, SpecularLobesAreChosenByAlbedo) {
  Bsdf b;
  b.reset(upward());
  b.add<Delta>(0.6f);
  b.add<Diffuse>(kReflection, 0.2f, 0.2f);
  EXPECT_FALSE(b.isSpecular());
  EXPECT_FALSE(b.isDiffuse());
  std::vector<double> remapped, specular;
  for (uint64_t i = 0; i < 100'000; ++i) {
    const auto s = b.sample(kWo, uniform(3, i, 0), {uniform(3, i, 1), uniform(3, i, 2)});
    ASSERT_TRUE(s);
    specular.push_back(s->isSpecular());
    if (!s->isSpecular()) {
      EXPECT_NEAR(s->pdf, 0.25f * std::abs(s->wi.z) * kInvPi, 1e-3f);
      EXPECT_FLOAT_EQ(s->pdf, b.pdf(kWo, s->wi));
      EXPECT_EQ(s->f, b.f(kWo, s->wi));
      continue;
    }
    EXPECT_NEAR(s->pdf, 0.75f, 1e-3f);
    EXPECT_FLOAT_EQ(s->f.r * b.absCosTheta(s->wi) * 0.75f, 0.6f * 0.75f);
    ASSERT_TRUE(s->eta >= 0 && s->eta < 1);
    remapped.push_back(static_cast<double>(s->eta));
  }
  EXPECT_EQ(meanTest(specular, 0.75, 1e-3), "");
  std::vector<double> counts(20), expected(20, static_cast<double>(remapped.size()) / 20);
  for (const double v : remapped) ++counts[static_cast<size_t>(v * 20)];
  EXPECT_EQ(chiSquareTest(counts, expected), "") << "uc is uniform again after the choice";
}

TEST(Bsdf, ScalesLobesFromOneOn) {
  Bsdf b;
  b.reset(upward());
  b.add<Diffuse>(kReflection, 0.5f, 0.5f);
  b.add<Diffuse>(kReflection, 0.5f, 0.5f);
  b.scaleLobes(1, Rgb(0.5f, 0, 2));
  const Rgb f = b.f(kWo, kWo);
  EXPECT_FLOAT_EQ(f.r, 0.75f * kInvPi);
  EXPECT_FLOAT_EQ(f.g, 0.5f * kInvPi);
  EXPECT_FLOAT_EQ(f.b, 1.5f * kInvPi);
}

TEST(Bsdf, AnyVariateAndGrazingDirectionsAreSafe) {
  Bsdf b;
  b.reset(upward());
  b.add<Delta>(0.6f);
  b.add<Diffuse>(kReflection, 0.2f, 0.f);
  b.add<Diffuse>(kTransmission, 0.2f, 1e-30f);
  for (const float z : {0.f, 1e-38f, 1e-9f, -1e-9f, 1e-6f, 0.1f, -0.1f, 1.f}) {
    const Vec3 wo(std::sqrt(1 - z * z), 0, z);
    for (const float uc : {0.f, 0.5f, 0.999f, kOneMinusEpsilon}) {
      for (const float u : {0.f, 0.5f, kOneMinusEpsilon}) {
        const auto s = b.sample(wo, uc, {u, uc});
        if (!s) continue;
        EXPECT_TRUE(s->f.isFinite() && std::isfinite(s->pdf) && s->pdf > 0);
        EXPECT_LT(s->f.r * b.absCosTheta(s->wi) / s->pdf, 2000);
      }
    }
  }
}

}  // namespace
}  // namespace lampyris::test
