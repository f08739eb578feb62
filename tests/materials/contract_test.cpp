// SPDX-License-Identifier: Apache-2.0
// What every material owes the integrators, checked for all of materialCases().
#include <gtest/gtest.h>

#include "core/sampling.h"
#include "material_cases.h"
#include "support/statistics.h"

namespace lampyris::test {
namespace {

/// From above and, third, fifth and seventh, from below.
constexpr float kAngles[] = {0.5f, 50, 130, 80, 100, 88, 179};

class EveryMaterial : public testing::TestWithParam<MaterialCase> {
 protected:
  EveryMaterial() : fixture_(GetParam()) { fixture_.evaluate(bsdf_); }
  std::optional<BsdfSample> draw(const Vec3& wo, uint64_t seed, uint64_t i) const {
    return bsdf_.sample(wo, uniform(seed, i, 0), {uniform(seed, i, 1), uniform(seed, i, 2)});
  }
  MaterialFixture fixture_;
  Bsdf bsdf_;
};

Vec3 randomDirection(uint64_t seed, uint64_t i, uint32_t dimension) {
  return sampleUniformSphere({uniform(seed, i, dimension), uniform(seed, i, dimension + 1)});
}

TEST_P(EveryMaterial, DrawsDirectionsWithItsDensity) {
  if (bsdf_.isSpecular()) return;
  // The grid's poles lie in the tangent plane, where no lobe is: cells are coarse there.
  const Frame& f = bsdf_.frame();
  const Frame gridFrame{f.z, f.x, f.y};
  for (const float angle : {0.5f, 50.f, 130.f, 80.f}) {
    const Vec3 wo = outgoing(bsdf_, angle);
    DirectionTest t;
    t.sample = [&](const Vec2& u, float uc, Vec3& w) {
      const auto s = bsdf_.sample(wo, uc, u);
      if (!s || s->isSpecular()) return false;
      w = gridFrame.toLocal(s->wi);
      return true;
    };
    t.pdf = [&](const Vec3& w) { return static_cast<double>(bsdf_.pdf(wo, gridFrame.toWorld(w))); };
    t.samples = 40'000;
    t.thetaCells = 16;
    t.phiCells = 24;
    t.subdivisions = GetParam().subdivisions;
    EXPECT_EQ(directionChiSquareTest(t), "") << "from " << angle << " degrees";
  }
}

TEST_P(EveryMaterial, SamplesCarryTheValueAndDensityOfTheirDirection) {
  for (const float angle : kAngles) {
    const Vec3 wo = outgoing(bsdf_, angle);
    for (uint64_t i = 0; i < 2000; ++i) {
      const auto s = draw(wo, 7, i);
      if (!s) continue;
      ASSERT_NEAR(length(s->wi), 1, 1e-5f);
      ASSERT_GT(s->pdf, 0);
      ASSERT_FALSE(s->f.isBlack());
      ASSERT_TRUE(s->f.isFinite() && s->f.r >= 0 && s->f.g >= 0 && s->f.b >= 0);
      ASSERT_EQ(s->isTransmission(), dot(wo, bsdf_.frame().z) * dot(s->wi, bsdf_.frame().z) < 0);
      if (s->isSpecular()) continue;
      const Rgb f = bsdf_.f(wo, s->wi);
      // World space rounds the direction: narrow lobes notice, and 1 − F next to total reflection.
      // Hair divides by the cosine, which rounds as well.
      const float slack = 3e-3f + 1e-6f / bsdf_.absCosTheta(s->wi);
      ASSERT_NEAR(f.luminance(), s->f.luminance(), slack * s->f.luminance() + 1e-6f) << angle;
      ASSERT_NEAR(bsdf_.pdf(wo, s->wi), s->pdf, 3e-3f * s->pdf) << angle;
    }
  }
}

TEST_P(EveryMaterial, IsReciprocal) {
  if (!GetParam().reciprocal) return;
  for (size_t k = 0; k < bsdf_.lobeCount(); ++k) {
    const Lobe& lobe = bsdf_.lobe(k);
    if (lobe.flags & kSpecular) continue;
    for (uint64_t i = 0; i < 2000; ++i) {
      const Vec3 a = randomDirection(5, i, 0), b = randomDirection(5, i, 2);
      // Radiance: f / η² is what is symmetric, with the η of the side that the light comes from.
      float scale = 1;
      if (!sameHemisphere(a, b) && (lobe.flags & kGlossy) && (lobe.flags & kTransmission))
        scale = a.z > 0 ? sqr(GetParam().eta) : 1 / sqr(GetParam().eta);
      const Rgb there = lobe.f(a, b) * scale, back = lobe.f(b, a);
      ASSERT_NEAR(there.r, back.r, 2e-3f * back.r + 1e-6f);
      ASSERT_NEAR(there.b, back.b, 2e-3f * back.b + 1e-6f);
    }
  }
}

TEST_P(EveryMaterial, NeverCreatesEnergy) {
  for (const float angle : kAngles) {
    const Vec3 wo = bsdf_.frame().toLocal(outgoing(bsdf_, angle));
    Rgb total;
    for (size_t k = 0; k < bsdf_.lobeCount(); ++k) {
      const Lobe& lobe = bsdf_.lobe(k);
      Rgb sum;
      constexpr uint64_t kDraws = 20'000;
      for (uint64_t i = 0; i < kDraws; ++i) {
        const auto s = lobe.sample(wo, uniform(9, i, 0), {uniform(9, i, 1), uniform(9, i, 2)});
        // Power, not radiance: the η² of transmission is taken out.
        if (s) sum += s->f * (std::abs(s->wi.z) / s->pdf * s->eta * s->eta);
      }
      total += sum / static_cast<float>(kDraws);
      EXPECT_TRUE(sum.isBlack() || lobe.albedo(wo) > 0) << "a lobe that scatters must be chosen";
    }
    EXPECT_LE(total.maxComponent(), GetParam().largestAlbedo + 0.01f) << angle;
  }
}

TEST_P(EveryMaterial, SamplingFindsAllThatItScatters) {
  for (const float angle : {50.f, 130.f, 80.f}) {
    const Vec3 wo = outgoing(bsdf_, angle);
    std::vector<double> values;
    for (uint64_t i = 0; i < 30'000; ++i) {
      const auto s = draw(wo, 11, i);
      values.push_back(s && !s->isSpecular()
                           ? static_cast<double>(s->f.g * bsdf_.absCosTheta(s->wi) / s->pdf)
                           : 0);
    }
    const int n = 20 * GetParam().subdivisions;
    double integral = 0;
    for (int y = 0; y < n; ++y) {
      for (int x = 0; x < n; ++x) {
        const float z = -1 + 2 * (static_cast<float>(y) + 0.5f) / static_cast<float>(n);
        const float phi = 2 * kPi * (static_cast<float>(x) + 0.5f) / static_cast<float>(n);
        const Vec3 w = bsdf_.frame().toWorld(sphericalDirection(std::sqrt(1 - z * z), z, phi));
        integral += static_cast<double>(bsdf_.f(wo, w).g * std::abs(z));
      }
    }
    integral *= 4 * M_PI / (n * n);
    EXPECT_EQ(meanTest(values, integral, 0.01 * integral), "") << angle;
  }
}

TEST_P(EveryMaterial, IsSafeWithAnyDirection) {
  const Frame& frame = bsdf_.frame();
  const auto direction = [&](uint64_t i, uint32_t dimension) {
    Vec3 w = randomDirection(13, i, dimension);
    const float zs[] = {0.f, 1e-9f, -1e-9f, 1e-7f, 1e-5f, -1e-5f, w.z, w.z};
    w = normalize(Vec3(w.x, w.y, zs[(i >> dimension) % 8]));
    return frame.toWorld(w);
  };
  const auto check = [&](const Vec3& wo, const Vec3& wi) {
    const Rgb f = bsdf_.f(wo, wi);
    const float pdf = bsdf_.pdf(wo, wi);
    ASSERT_TRUE(f.isFinite() && f.r >= 0 && f.g >= 0 && f.b >= 0);
    ASSERT_TRUE(std::isfinite(pdf) && pdf >= 0);
  };
  const float corners[] = {0, 1e-7f, 0.5f, kOneMinusEpsilon};
  for (uint64_t i = 0; i < 4000; ++i) {
    const Vec3 wo = direction(i, 0);
    check(wo, direction(i, 3));
    check(wo, wo);
    check(wo, -wo);
    check(wo, wo - 2 * dot(wo, frame.z) * frame.z);
    const auto s = bsdf_.sample(wo, corners[i % 4], {corners[i / 4 % 4], corners[i / 16 % 4]});
    if (!s) continue;
    ASSERT_TRUE(isFinite(s->wi) && std::isfinite(s->pdf) && s->pdf > 0);
    ASSERT_TRUE(s->f.isFinite());
    ASSERT_LT(s->f.luminance() * bsdf_.absCosTheta(s->wi) / s->pdf, 1e4f);
  }
}

INSTANTIATE_TEST_SUITE_P(All, EveryMaterial, testing::ValuesIn(materialCases()),
                         [](const auto& test) {
                           return test.param.plugin + std::to_string(test.index);
                         });

}  // namespace
}  // namespace lampyris::test
