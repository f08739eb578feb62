// SPDX-License-Identifier: Apache-2.0
// The lobes of "disney" against the papers' formulas in double precision.
#include <gtest/gtest.h>

#include "core/sampling.h"
#include "material_cases.h"
#include "materials/disney_lobes.h"
#include "support/statistics.h"

namespace lampyris::test {
namespace {

Vec3 upperDirection(uint64_t i, uint32_t dimension) {
  Vec3 w = sampleUniformSphere({uniform(22, i, dimension), uniform(22, i, dimension + 1)});
  w.z = std::abs(w.z);
  return w;
}

TEST(DisneyBase, AddsBurleysTerms) {
  const double rough = 0.7;
  const DisneyBase lobe({Rgb(1, 0, 0), Rgb(0, 1, 0), Rgb(0, 0, 1), Rgb()}, 0.7f);
  const DisneyBase sheen({Rgb(), Rgb(), Rgb(), Rgb(0.5f)}, 0.7f);
  for (uint64_t i = 0; i < 1000; ++i) {
    const Vec3 wo = upperDirection(i, 0), wi = upperDirection(i, 2);
    const glm::dvec3 o(wo), n(wi);
    const double d = glm::dot(n, glm::normalize(o + n)), d2 = d * d;
    const double fo = std::pow(1 - o.z, 5), fi = std::pow(1 - n.z, 5);
    const Rgb f = lobe.f(wo, wi);
    EXPECT_NEAR(f.r, (1 - fo / 2) * (1 - fi / 2) / M_PI, 1e-5);
    const double ss = (1 + (d2 * rough - 1) * fo) * (1 + (d2 * rough - 1) * fi);
    const double flat = 1.25 / M_PI * (ss * (1 / (o.z + n.z) - 0.5) + 0.5);
    EXPECT_NEAR(f.g, flat, 1e-4 * flat);
    const double r = 2 * rough * d2;
    EXPECT_NEAR(f.b, r / M_PI * (fo + fi + fo * fi * (r - 1)), 1e-5);
    EXPECT_NEAR(sheen.f(wo, wi).r, 0.5 * std::pow(1 - d, 5), 1e-5);
  }
}

TEST(DisneyClearcoat, FacetsAreNormalisedAndTheValueIsBurleys) {
  const double alpha = 0.1, a2 = alpha * alpha;
  const DisneyClearcoat lobe(1, 0);
  for (uint64_t i = 0; i < 1000; ++i) {
    const Vec3 wo = upperDirection(i, 0), wi = upperDirection(i, 2);
    const glm::dvec3 o(wo), n(wi), m = glm::normalize(o + n);
    const double density = (a2 - 1) / (M_PI * std::log(a2) * (1 + (a2 - 1) * m.z * m.z));
    const auto g = [](double c) { return 1 / (c + std::sqrt(0.0625 + c * c - 0.0625 * c * c)); };
    const double fresnel = 0.04 + 0.96 * std::pow(1 - glm::dot(o, m), 5);
    const double expected = density * fresnel * g(o.z) * g(n.z) / 4;
    EXPECT_NEAR(lobe.f(wo, wi).r, expected, 1e-3 * expected);
  }
}

TEST(Disney, ParametersReachTheirLobes) {
  const auto bsdf = [](const TestParameters::List& parameters, Bsdf& b) {
    MaterialFixture("disney", parameters).evaluate(b);
  };
  Bsdf plain, metal, glass, thin, coated;
  bsdf({}, plain), bsdf({{"metallic", "1"}, {"color", "0.9 0.4 0.1"}}, metal);
  bsdf({{"spectrans", "1"}}, glass), bsdf({{"thin", "true"}}, thin);
  bsdf({{"clearcoat", "1"}, {"clearcoatgloss", "1"}}, coated);
  EXPECT_EQ(plain.lobeCount(), 2u);
  EXPECT_FALSE(plain.transmits());
  EXPECT_EQ(metal.lobeCount(), 1u) << "no diffuse part";
  EXPECT_TRUE(glass.transmits());
  EXPECT_EQ(coated.lobeCount(), 3u);

  const Vec3 up = metal.frame().z;
  const Vec3 oblique = outgoing(metal, 30);
  const Rgb mirrored = metal.f(up, oblique);
  EXPECT_NEAR(mirrored.r / mirrored.b, 9, 0.1f) << "a metal reflects its colour";
  EXPECT_NEAR(plain.f(up, -oblique).r, 0, 0);
  EXPECT_FLOAT_EQ(thin.f(up, -oblique).r, 0.25f * kInvPi) << "half of the colour passes the sheet";
  EXPECT_GT(coated.f(up, up).g, 10 * plain.f(up, up).g);
}

TEST(Disney, AnisotropyStretchesTheHighlightAlongU) {
  Bsdf b;
  MaterialFixture("disney", {{"metallic", "1"}, {"roughness", "0.5"}, {"anisotropic", "1"}})
      .evaluate(b);
  const Frame& f = b.frame();
  const Vec3 alongU = normalize(f.z + 0.5f * f.x), alongV = normalize(f.z + 0.5f * f.y);
  EXPECT_GT(b.f(f.z, alongU).g, 3 * b.f(f.z, alongV).g);
}

}  // namespace
}  // namespace lampyris::test
