// SPDX-License-Identifier: Apache-2.0
// Lobes against the textbook's formulas, written with angles and in double precision.
#include <gtest/gtest.h>

#include "core/sampling.h"
#include "materials/fresnel_blend.h"
#include "materials/lambert.h"
#include "materials/microfacet_reflection.h"
#include "materials/oren_nayar.h"
#include "materials/rough_dielectric.h"
#include "materials/roughness.h"
#include "materials/smooth_dielectric.h"
#include "support/statistics.h"

namespace lampyris::test {
namespace {

using Double3 = glm::dvec3;

Vec3 randomDirection(uint64_t i, uint32_t dimension) {
  return sampleUniformSphere({uniform(21, i, dimension), uniform(21, i, dimension + 1)});
}

double tanTheta(const Double3& w) { return std::sqrt(std::max(0., 1 - w.z * w.z)) / w.z; }

/// D after Walter et al. 2007, eq. 33, anisotropic.
double referenceDensity(const Double3& m, double ax, double ay) {
  const double t2 = tanTheta(m) * tanTheta(m), c4 = std::pow(m.z, 4), s2 = 1 - m.z * m.z;
  const double e = s2 > 0 ? t2 * (m.x * m.x / (ax * ax) + m.y * m.y / (ay * ay)) / s2 : 0;
  return 1 / (M_PI * ax * ay * c4 * (1 + e) * (1 + e));
}
double referenceLambda(const Double3& w, double ax, double ay) {
  const double s2 = 1 - w.z * w.z;
  const double alpha2 = (w.x * w.x * ax * ax + w.y * w.y * ay * ay) / s2;
  return (std::sqrt(1 + alpha2 * tanTheta(w) * tanTheta(w)) - 1) / 2;
}
double referenceG(const Double3& a, const Double3& b, double ax, double ay) {
  return 1 / (1 + referenceLambda(a, ax, ay) + referenceLambda(b, ax, ay));
}

TEST(Fresnel, DielectricKnownValues) {
  EXPECT_NEAR(fresnelDielectric(1, 1.5f), 0.04f, 1e-6f);
  EXPECT_NEAR(fresnelDielectric(-1, 1.5f), 0.04f, 1e-6f);
  EXPECT_EQ(fresnelDielectric(0, 1.5f), 1);
  EXPECT_EQ(fresnelDielectric(0.3f, 1), 0);
  EXPECT_EQ(fresnelDielectric(0, 1), 0);
  // Beyond the critical angle: sin θ > 1 / 1.5.
  EXPECT_EQ(fresnelDielectric(0.74f, 1 / 1.5f), 1);
  EXPECT_EQ(fresnelDielectric(-0.74f, 1.5f), 1);
  EXPECT_LT(fresnelDielectric(0.75f, 1 / 1.5f), 1);
  // At Brewster's angle only the perpendicular part is reflected: ((n² − 1) / (n² + 1))² / 2.
  EXPECT_NEAR(fresnelDielectric(std::cos(std::atan(1.5f)), 1.5f), 0.5f * sqr(1.25f / 3.25f), 1e-6f);
}

TEST(Fresnel, DielectricIsTheSameFromBothSides) {
  for (float sinI = 0; sinI < 1; sinI += 0.05f) {
    const float cosI = std::sqrt(1 - sinI * sinI), sinT = sinI / 1.7f;
    const float cosT = std::sqrt(1 - sinT * sinT);
    EXPECT_NEAR(fresnelDielectric(cosI, 1.7f), fresnelDielectric(-cosT, 1.7f), 1e-5f);
  }
}

TEST(Fresnel, ConductorKnownValues) {
  const float eta = 0.92f, k = 2.45f;
  EXPECT_NEAR(fresnelConductor(1, eta, k), (sqr(eta - 1) + k * k) / (sqr(eta + 1) + k * k), 1e-6f);
  EXPECT_NEAR(fresnelConductor(0, eta, k), 1, 1e-6f);
  for (float c = 0.05f; c <= 1; c += 0.05f)
    EXPECT_NEAR(fresnelConductor(c, 1.5f, 0), fresnelDielectric(c, 1.5f), 1e-5f);
}

TEST(Fresnel, ConductorIsSafe) {
  for (const float eta : {0.f, 1e-6f, 1.f, 1e6f})
    for (const float k : {0.f, 1e-6f, 1.f, 1e6f})
      for (const float c : {0.f, 1e-7f, 0.5f, 1.f}) {
        const float r = fresnelConductor(c, eta, k);
        EXPECT_TRUE(r >= 0 && r <= 1) << eta << " " << k << " " << c;
      }
}

TEST(Roughness, RemapsAsPbrt) {
  EXPECT_NEAR(roughnessToAlpha(1), 1.62142f, 1e-5f);
  // ln 0.1 = −2.302585.
  EXPECT_NEAR(roughnessToAlpha(0.1f), 1.62142f - 1.888016f + 0.919345f - 0.209000f + 0.018010f,
              1e-4f);
  EXPECT_EQ(roughnessToAlpha(0), roughnessToAlpha(1e-3f));
  EXPECT_EQ(roughnessToAlpha(std::nanf("")), roughnessToAlpha(1e-3f));
  EXPECT_NEAR(roughnessToAlpha(1e-3f), 0.0473f, 1e-3f);
}

TEST(TrowbridgeReitz, FacetsCoverTheSurface) {
  for (const auto& [ax, ay] : {std::pair(0.1f, 0.1f), {0.3f, 1.2f}, {2.f, 0.5f}}) {
    const TrowbridgeReitz d(ax, ay);
    double sum = 0;
    const int n = 10'000, columns = 100;
    for (int y = 0; y < n; ++y)
      for (int x = 0; x < columns; ++x) {
        const float z = (static_cast<float>(y) + 0.5f) / n;
        const float phi = 2 * kPi * (static_cast<float>(x) + 0.5f) / columns;
        const Vec3 m = sphericalDirection(std::sqrt(1 - z * z), z, phi);
        sum += static_cast<double>(d.density(m) * z);
      }
    EXPECT_NEAR(sum * 2 * M_PI / (n * columns), 1, 2e-3) << ax << " " << ay;
  }
}

TEST(TrowbridgeReitz, DrawsVisibleNormalsWithTheirDensity) {
  const TrowbridgeReitz d(0.4f, 0.9f);
  for (const float angle : {1.f, 60.f, 80.f}) {
    const Vec3 w = sphericalDirection(std::sin(radians(angle)), std::cos(radians(angle)), 1);
    DirectionTest t;
    t.sample = [&](const Vec2& u, float, Vec3& m) { return m = d.sampleVisible(w, u), true; };
    t.pdf = [&](const Vec3& m) {
      return m.z > 0 ? static_cast<double>(d.density(m) * std::max(0.f, dot(w, m)) *
                                           d.visibilityOverCosine(w))
                     : 0;
    };
    EXPECT_EQ(directionChiSquareTest(t), "") << angle;
  }
  DirectionTest t;
  t.sample = [&](const Vec2& u, float, Vec3& m) { return m = d.sampleAll(u), true; };
  t.pdf = [&](const Vec3& m) { return m.z > 0 ? static_cast<double>(d.density(m) * m.z) : 0; };
  EXPECT_EQ(directionChiSquareTest(t), "");
}

TEST(MicrofacetReflection, IsTorranceAndSparrows) {
  const float ax = 0.3f, ay = 0.7f;
  const MicrofacetReflection<DielectricFresnel> lobe(Rgb(0.5f), {ax, ay}, {1.5f});
  for (uint64_t i = 0; i < 1000; ++i) {
    const Vec3 wo = randomDirection(i, 0), wi = randomDirection(i, 2);
    const Double3 o(wo), n(wi), m = glm::normalize(o + n);
    const double cosine = glm::dot(n, m.z < 0 ? -m : m);
    const double expected =
        0.5 * static_cast<double>(fresnelDielectric(static_cast<float>(cosine), 1.5f)) *
        referenceDensity(m, ax, ay) * referenceG(o, n, ax, ay) / (4 * std::abs(o.z * n.z));
    EXPECT_NEAR(lobe.f(wo, wi).r, expected, 1e-3 * expected);
  }
}

TEST(RoughDielectric, IsWaltersRefraction) {
  const float ax = 0.3f, ay = 0.7f, index = 1.5f;
  const RoughDielectric<> lobe(Rgb(0.8f), Rgb(0.5f), {ax, ay}, index);
  int transmitted = 0;
  for (uint64_t i = 0; i < 4000; ++i) {
    const Vec3 wo = randomDirection(i, 0), wi = randomDirection(i, 2);
    if (wo.z * wi.z > 0) continue;
    const Double3 o(wo), n(wi);
    const double eta = wo.z > 0 ? index : 1 / double(index);
    Double3 m = glm::normalize(o + n * eta);
    if (m.z < 0) m = -m;
    const double om = glm::dot(o, m), im = glm::dot(n, m);
    const bool facing = om * o.z > 0 && im * n.z > 0;
    const double share = 1 - static_cast<double>(fresnelDielectric(static_cast<float>(om), index));
    const double denominator = om + eta * im;
    const double expected = facing ? 0.5 * share * referenceDensity(m, ax, ay) *
                                         referenceG(o, n, ax, ay) *
                                         std::abs(im * om / (o.z * n.z * denominator * denominator))
                                   : 0;
    transmitted += expected > 0;
    // Next to total reflection 1 − F keeps few digits.
    EXPECT_NEAR(lobe.f(wo, wi).r, expected, 2e-3 * expected + 1e-6);
  }
  EXPECT_GT(transmitted, 100);
}

TEST(FresnelBlend, IsAshikhminAndShirleys) {
  const double rd = 0.4, rs = 0.3;
  const float alpha = 0.5f;
  const FresnelBlend lobe(Rgb(0.4f), Rgb(0.3f), {alpha, alpha});
  for (uint64_t i = 0; i < 1000; ++i) {
    const Vec3 wo = randomDirection(i, 0), wi = randomDirection(i, 2);
    const Double3 o(wo), n(wi), m = glm::normalize(o + n);
    const double co = std::abs(o.z), ci = std::abs(n.z), c = std::abs(glm::dot(n, m));
    const double diffuse = 28 * rd / (23 * M_PI) * (1 - rs) * (1 - std::pow(1 - ci / 2, 5)) *
                           (1 - std::pow(1 - co / 2, 5));
    const double coat = referenceDensity(m, alpha, alpha) / (4 * c * std::max(co, ci)) *
                        (rs + std::pow(1 - c, 5) * (1 - rs));
    EXPECT_NEAR(lobe.f(wo, wi).r, diffuse + coat, 1e-3 * (diffuse + coat));
  }
}

TEST(OrenNayar, IsTheirQualitativeModel) {
  const double sigma = 30 * M_PI / 180, s2 = sigma * sigma;
  const OrenNayar lobe(Rgb(0.6f), 30);
  const double a = 1 - s2 / (2 * (s2 + 0.33)), b = 0.45 * s2 / (s2 + 0.09);
  for (uint64_t i = 0; i < 1000; ++i) {
    Vec3 wo = randomDirection(i, 0), wi = randomDirection(i, 2);
    wo.z = std::abs(wo.z), wi.z = std::abs(wi.z);
    const double to = std::acos(static_cast<double>(wo.z)),
                 ti = std::acos(static_cast<double>(wi.z));
    const double dPhi =
        std::atan2(double(wo.y), double(wo.x)) - std::atan2(double(wi.y), double(wi.x));
    const double expected = 0.6 / M_PI *
                            (a + b * std::max(0., std::cos(dPhi)) * std::sin(std::max(to, ti)) *
                                     std::tan(std::min(to, ti)));
    EXPECT_NEAR(lobe.f(wo, wi).r, expected, 1e-4 * expected);
  }
}

TEST(SmoothDielectric, RefractsBySnellAndConservesEnergy) {
  const SmoothDielectric lobe(Rgb(1), Rgb(1), 1.5f);
  for (const float z : {1.f, 0.7f, 0.1f, -0.1f, -0.8f, -1.f}) {
    const Vec3 wo(std::sqrt(1 - z * z), 0, z);
    double energy = 0;
    for (const float uc : {0.f, kOneMinusEpsilon}) {
      const auto s = lobe.sample(wo, uc, {});
      ASSERT_TRUE(s);
      const float weight = s->f.r * std::abs(s->wi.z) / s->pdf;
      if (s->flags & kReflection) {
        EXPECT_EQ(s->wi, Vec3(-wo.x, 0, z));
        EXPECT_EQ(s->eta, 1);
        EXPECT_NEAR(weight, 1, 1e-5f);
        EXPECT_NEAR(s->pdf, fresnelDielectric(z, 1.5f), 1e-6f);
      } else {
        const float eta = z > 0 ? 1.5f : 1 / 1.5f;
        EXPECT_EQ(s->eta, eta);
        EXPECT_NEAR(length(s->wi), 1, 1e-6f);
        EXPECT_NEAR(s->wi.x * eta, -wo.x, 1e-6f);
        EXPECT_LT(s->wi.z * z, 0);
        EXPECT_NEAR(weight, 1 / sqr(eta), 1e-5f) << "radiance";
      }
      energy += s->flags & kReflection && s->pdf == 1 ? 0.5 : static_cast<double>(s->pdf);
    }
    EXPECT_NEAR(energy, 1, 1e-6);
  }
}

TEST(SmoothDielectric, WithoutRefractionPassesStraightOn) {
  const SmoothDielectric lobe(Rgb(), Rgb(0.25f), 1);
  const Vec3 wo = normalize(Vec3(1, 2, -0.01f));
  const auto s = lobe.sample(wo, 0, {});
  ASSERT_TRUE(s);
  EXPECT_EQ(s->wi, -wo);
  EXPECT_FLOAT_EQ(s->f.r * std::abs(wo.z) / s->pdf, 0.25f);
  EXPECT_FALSE(lobe.flags & kReflection);
}

TEST(Lobes, WhiteLambertReflectsAll) {
  const LambertReflection lobe(Rgb(1));
  for (uint64_t i = 0; i < 100; ++i) {
    const auto s = lobe.sample({0, 0.6f, -0.8f}, 0, {uniform(1, i, 0), uniform(1, i, 1)});
    ASSERT_TRUE(s);
    EXPECT_LT(s->wi.z, 0);
    EXPECT_NEAR(s->f.r * std::abs(s->wi.z) / s->pdf, 1, 1e-5f);
  }
}

}  // namespace
}  // namespace lampyris::test
