// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "core/sampling.h"
#include "material_cases.h"
#include "materials/hair_lobe.h"
#include "support/statistics.h"

namespace lampyris::test {
namespace {

Vec3 direction(uint64_t seed, uint64_t i) {
  return sampleUniformSphere({uniform(seed, i, 0), uniform(seed, i, 1)});
}

HairLobe clearHair(float h, float betaM, float betaN) {
  return HairLobe({h, 1.55f, Rgb(0), betaM, betaN, 2});
}

TEST(HairLobe, WithoutAbsorptionScattersAllLight) {
  for (const float betaM : {0.1f, 0.4f, 1.f})
    for (const float betaN : {0.1f, 0.5f, 1.f}) {
      std::vector<double> albedos;
      for (uint64_t i = 0; i < 60'000; ++i) {
        const HairLobe lobe = clearHair(2 * uniform(41, i, 5) - 1, betaM, betaN);
        const Vec3 wo = normalize(Vec3(0.4f, 0.5f, 0.7f)), wi = direction(41, i);
        albedos.push_back(static_cast<double>(lobe.f(wo, wi).g * std::abs(wi.z) * 4 * kPi));
      }
      EXPECT_EQ(meanTest(albedos, 1, 1e-3), "") << betaM << " " << betaN;
    }
}

TEST(HairLobe, SamplesOfClearHairWeighOne) {
  for (uint64_t i = 0; i < 2000; ++i) {
    const HairLobe lobe = clearHair(2 * uniform(42, i, 5) - 1, 0.3f, 0.4f);
    const auto s =
        lobe.sample(direction(43, i), uniform(42, i, 2), {uniform(42, i, 3), uniform(42, i, 4)});
    ASSERT_TRUE(s);
    ASSERT_NEAR(s->f.r * std::abs(s->wi.z) / s->pdf, 1, 1e-3f);
  }
}

TEST(HairLobe, LongitudinalLobesAreNormalised) {
  // Narrow and wide: both branches of the Bessel function.
  for (const float betaM : {0.05f, 0.2f, 0.5f, 1.f}) {
    const HairLobe lobe = clearHair(0.3f, betaM, 1);
    const Vec3 wo = normalize(Vec3(0.3f, 0.2f, 0.8f));
    double integral = 0;
    constexpr int kX = 2000, kPhi = 40;
    for (int x = 0; x < kX; ++x)
      for (int y = 0; y < kPhi; ++y) {
        const float z = -1 + 2 * (static_cast<float>(x) + 0.5f) / kX;
        const float phi = 2 * kPi * (static_cast<float>(y) + 0.5f) / kPhi;
        const float across = std::sqrt(1 - z * z);
        integral +=
            static_cast<double>(lobe.pdf(wo, {z, across * std::cos(phi), across * std::sin(phi)}));
      }
    EXPECT_NEAR(integral * 4 * M_PI / (kX * kPhi), 1, 5e-3) << betaM;
  }
}

TEST(HairLobe, TheFirstHighlightIsTiltedByTwiceTheScalesAngle) {
  // Dark hair reflects off its surface only.
  const HairLobe lobe({0, 1.55f, Rgb(1e4f), 0.1f, 0.1f, 5});
  const Vec3 wo(0, 0, 1);
  float best = 0, bestAngle = 0;
  for (float angle = -30; angle < 30; angle += 0.25f) {
    const float t = radians(angle);
    const float value = lobe.f(wo, {std::sin(t), 0, std::cos(t)}).g * std::cos(t);
    if (value > best) best = value, bestAngle = angle;
  }
  EXPECT_NEAR(bestAngle, 10, 1);
}

TEST(HairLobe, AbsorptionColoursWhatPassesThrough) {
  const HairLobe lobe({0.2f, 1.55f, Rgb(0.1f, 1, 4), 0.3f, 0.3f, 2});
  const Rgb through = lobe.f({0, 0, 1}, normalize(Vec3(0, 0.2f, -1)));
  EXPECT_GT(through.r, 2 * through.g);
  EXPECT_GT(through.g, 5 * through.b);
}

TEST(HairAbsorption, OfColourIsThePapersFit) {
  // ln(0.5) / 5.969 at β = 0; the coefficients add up to 3.375 at β = 1.
  EXPECT_NEAR(hairAbsorptionOfColor(Rgb(0.5f), 0).g, sqr(std::log(0.5f) / 5.969f), 1e-6f);
  EXPECT_NEAR(hairAbsorptionOfColor(Rgb(0.5f), 1).g, sqr(std::log(0.5f) / 3.375f), 1e-5f);
  EXPECT_EQ(hairAbsorptionOfColor(Rgb(1), 0.3f).g, 0);
  EXPECT_TRUE(hairAbsorptionOfColor(Rgb(0, -1, 2), 0.3f).isFinite());
  EXPECT_FLOAT_EQ(hairAbsorptionOfMelanin(2, 1).b, 2 * 1.37f + 1.05f);
}

Rgb value(const TestParameters::List& parameters) {
  Bsdf b;
  MaterialFixture("hair", parameters).evaluate(b);
  return b.f(outgoing(b, 20), outgoing(b, 120, 215));
}

TEST(Hair, ColoursCountInOrder) {
  const Rgb standard = value({});
  EXPECT_EQ(value({{"eumelanin", "1.3"}}), standard);
  EXPECT_NEAR(value({{"sigma_a", "0.5447 0.9061 1.781"}, {"color", "0.1 0.2 0.3"}}).r, standard.r,
              1e-4f * standard.r);
  EXPECT_EQ(value({{"color", "0.1 0.2 0.3"}, {"eumelanin", "8"}}),
            value({{"color", "0.1 0.2 0.3"}}));
  EXPECT_NE(value({{"pheomelanin", "0.5"}}), standard);
  MaterialFixture both("hair", {{"color", "0.1 0.2 0.3"}, {"eumelanin", "8"}});
  EXPECT_EQ(both.build().warnings.size(), 1u);
}

TEST(Hair, ScattersOnBothSidesWhateverTheNormals) {
  SurfaceInteraction at = tiltedSurface();
  at.shading.n = normalize(at.n + 0.8f * normalize(at.dpdu));
  const MaterialFixture m("hair", {});
  Bsdf b;
  m->evaluate(at, b);
  // Above the shading normal's plane, below the geometric one's.
  const Vec3 wi = normalize(normalize(at.dpdu) - 0.2f * at.n);
  ASSERT_GT(dot(wi, at.shading.n), 0);
  EXPECT_FALSE(b.f(at.n, wi).isBlack());
}

}  // namespace
}  // namespace lampyris::test
