// SPDX-License-Identifier: Apache-2.0
// Diffusion profiles: against random walks, their own integrals, and the densities of their draws.
#include <gtest/gtest.h>

#include "base/measured_media.h"
#include "core/sampling.h"
#include "material_cases.h"
#include "materials/registry.h"
#include "materials/separable_bssrdf.h"
#include "support/statistics.h"

namespace lampyris::test {
namespace {

TEST(FresnelDiffuse, IsTheCosineWeightedMean) {
  for (const double eta : {0.4, 0.75, 1.001, 1.3, 1.5, 2.5, 10.}) {
    double sum = 0;
    constexpr int kSteps = 200'000;
    for (int i = 0; i < kSteps; ++i) {
      const float c = (static_cast<float>(i) + 0.5f) / kSteps;
      sum += static_cast<double>(2 * c * fresnelDielectric(c, static_cast<float>(eta)));
    }
    EXPECT_NEAR(fresnelDiffuse(eta), sum / kSteps, 1e-4) << eta;
  }
  EXPECT_EQ(fresnelDiffuse(1), 0);
}

/// Share of the light of a beam at normal incidence that comes out, by random walks in a half-space
/// with extinction 1 that scatters alike in all directions; without the beam's own reflection.
double walkedReflectance(float albedo, float eta, int walks) {
  double sum = 0;
  for (uint64_t i = 0; i < static_cast<uint64_t>(walks); ++i) {
    Vec3 p(0), w(0, 0, -1);
    float weight = 1;
    uint32_t dimension = 0;
    const auto next = [&] { return uniform(61, i, dimension++); };
    while (weight > 1e-3f) {
      p += -std::log1p(-next()) * w;
      if (p.z > 0) {
        const float inside = fresnelDielectric(w.z, 1 / eta);
        sum += static_cast<double>(weight * (1 - inside));
        weight *= inside;
        w.z = -w.z;
        p.z = -p.z;
      }
      weight *= albedo;
      const float u = next();
      w = sampleUniformSphere({u, next()});
    }
  }
  return sum / walks;
}

TEST(DiffusionTable, ReflectsAboutAsMuchAsRandomWalks) {
  // The mirrored step above is exact: ways are without memory. Diffusion itself is an
  // approximation.
  for (const float eta : {1.f, 1.4f}) {
    const DiffusionTable table(0, eta);
    for (const float albedo : {0.5f, 0.9f, 0.98f}) {
      const double walked = walkedReflectance(albedo, eta, 8000);
      EXPECT_NEAR(static_cast<double>(table.profile(albedo).total()), walked, 0.15 * walked)
          << eta << " " << albedo;
    }
  }
}

TEST(DiffusionTable, ReflectanceGrowsWithTheAlbedoAndIsInverted) {
  const DiffusionTable table(0.3f, 1.33f);
  float last = -1;
  for (float albedo = 0; albedo <= 1; albedo += 0.01f) {
    const float total = table.profile(albedo).total();
    EXPECT_GT(total, last);
    last = total;
    EXPECT_NEAR(table.albedoOfReflectance(total), albedo, 2e-3f);
  }
  EXPECT_LT(last, 1.05f);
  EXPECT_EQ(table.albedoOfReflectance(-1), 0);
  EXPECT_EQ(table.albedoOfReflectance(7), 1);
}

/// ∫ f(r) 2π r dr from 0 to `end`.
template <class F>
double radialIntegral(const F& f, double end) {
  double sum = 0;
  constexpr int kSteps = 20'000;
  // r = end x³: dense where profiles are steep.
  for (int i = 0; i < kSteps; ++i) {
    const double x = (i + 0.5) / kSteps, r = end * x * x * x;
    sum += static_cast<double>(f(static_cast<float>(r))) * 2 * M_PI * r * 3 * end * x * x / kSteps;
  }
  return sum;
}

void expectExact(const Bssrdf& b, int channel, double end) {
  EXPECT_NEAR(radialIntegral([&](float r) { return b.pdfRadius(channel, r); }, end), 1, 0.01);
  constexpr int kCells = 30, kDraws = 20'000;
  std::vector<double> observed(kCells + 1), expected(kCells + 1);
  const auto edge = [&](int i) { return end * std::pow(i / static_cast<double>(kCells), 3); };
  float last = 0;
  for (int i = 0; i < kDraws; ++i) {
    const auto r = b.sampleRadius(channel, (static_cast<float>(i) + 0.5f) / kDraws);
    ASSERT_TRUE(r);
    // Burley's second exponential begins anew.
    EXPECT_TRUE(*r >= last || i == kDraws / 4);
    last = *r;
    const double cell = std::cbrt(static_cast<double>(*r) / end) * kCells;
    ++observed[std::min<size_t>(static_cast<size_t>(cell), kCells)];
  }
  const auto density = [&](float r) { return b.pdfRadius(channel, r); };
  double below = 0;
  for (int c = 0; c < kCells; ++c) {
    const double up = radialIntegral(density, edge(c + 1));
    expected[static_cast<size_t>(c)] = kDraws * (up - below);
    below = up;
  }
  expected[kCells] = kDraws * std::max(0., 1 - below);
  EXPECT_EQ(chiSquareTest(observed, expected), "");
}

TEST(TabulatedBssrdf, DrawsItsProfile) {
  const DiffusionTable table(0, 1.4f);
  const Rgb sigmaA(0.1f, 0.01f, 2), sigmaS(1, 5, 0.5f);
  const TabulatedBssrdf b(table, 1.4f, sigmaA, sigmaS);
  for (const int channel : {0, 1, 2}) expectExact(b, channel, 10);
  const auto red = [&](float r) { return b.profile(r).r; };
  EXPECT_NEAR(radialIntegral(red, 100), static_cast<double>(table.profile(1 / 1.1f).total()),
              0.005);
}

TEST(TabulatedBssrdf, ScalesWithTheUnitOfLength) {
  const DiffusionTable table(0, 1.4f);
  const TabulatedBssrdf b(table, 1.4f, Rgb(0.1f), Rgb(1));
  for (const float unit : {1e-4f, 1e4f}) {
    const TabulatedBssrdf scaled(table, 1.4f, Rgb(0.1f / unit), Rgb(1 / unit));
    EXPECT_NEAR(scaled.profile(0.7f * unit).g * unit * unit, b.profile(0.7f).g, 1e-4f);
    EXPECT_NEAR(*scaled.sampleRadius(1, 0.3f) / unit, *b.sampleRadius(1, 0.3f), 1e-4f);
  }
}

TEST(TabulatedBssrdf, IsDarkWithoutAMedium) {
  const DiffusionTable table(0, 1.4f);
  const TabulatedBssrdf b(table, 1.4f, Rgb(0, 1, 0), Rgb(0, 0, 1));
  EXPECT_FALSE(b.sampleRadius(0, 0.5f)) << "no extinction";
  EXPECT_FALSE(b.sampleRadius(1, 0.5f)) << "no scattering";
  EXPECT_TRUE(b.sampleRadius(2, 0.5f));
  EXPECT_EQ(b.profile(0.5f).r, 0);
  EXPECT_EQ(b.profile(0.5f).g, 0);
  EXPECT_TRUE(b.profile(0).isFinite());
}

TEST(BurleyBssrdf, DrawsItsProfileWhichHoldsTheReflectance) {
  const BurleyBssrdf b(Rgb(0.8f, 0.4f, 0.2f), Rgb(1, 0.5f, 0), 1.5f);
  for (const int channel : {0, 1}) expectExact(b, channel, 10);
  EXPECT_NEAR(radialIntegral([&](float r) { return b.profile(r).r; }, 20), 0.8, 0.005);
  EXPECT_NEAR(radialIntegral([&](float r) { return b.profile(r).b; }, 0.1), 0.2, 0.005);
  EXPECT_TRUE(b.profile(0).isFinite());
}

TEST(DiffuseEntry, LetsDiffuseLightInWhole) {
  for (const float eta : {0.8f, 1.f, 1.5f}) {
    const DiffuseEntry lobe(eta);
    std::vector<double> weights;
    for (uint64_t i = 0; i < 20'000; ++i) {
      const auto s = lobe.sample({0, 0, 1}, 0, {uniform(62, i, 0), uniform(62, i, 1)});
      weights.push_back(s ? static_cast<double>(s->f.g * s->wi.z / (s->pdf * sqr(eta))) : 0);
    }
    EXPECT_EQ(meanTest(weights, 1, 1e-4), "") << eta;
  }
}

TEST(MeasuredMedia, AreFoundByName) {
  const MeasuredMedium* skin = findMeasuredMedium("Skin1");
  ASSERT_TRUE(skin);
  EXPECT_EQ(skin->sigmaA.g, 0.17f);
  EXPECT_EQ(skin->sigmaPrimeS.b, 1.01f);
  EXPECT_FALSE(findMeasuredMedium("skin1"));
  EXPECT_EQ(measuredMediumNames().size(), 47u);
}

/// The profile of a material at distance r.
Rgb profile(const std::string& plugin, const TestParameters::List& parameters, float r) {
  const MaterialFixture m(plugin, parameters);
  BssrdfStorage storage;
  const Bssrdf* b = m->bssrdf(tiltedSurface(), storage);
  return b ? b->profile(r) : Rgb();
}

TEST(Subsurface, TakesNamedMediaAndScales) {
  const Rgb skin = profile("subsurface", {{"name", "Skin1"}, {"scale", "2"}}, 0.3f);
  EXPECT_EQ(skin, profile("subsurface",
                          {{"sigma_a", "0.064 0.34 0.96"}, {"sigma_s", "1.48 1.76 2.02"}}, 0.3f));
  EXPECT_EQ(skin, profile("subsurface", {{"name", "Skin1"}, {"scale", "2"}, {"g", "0.9"}}, 0.3f))
      << "reduced scattering has no direction left";
  EXPECT_NE(skin, profile("subsurface", {{"name", "Skin2"}, {"scale", "2"}}, 0.3f));
  EXPECT_THROW(MaterialFixture("subsurface", {{"name", "Skin3"}}), SceneError);
  EXPECT_THROW(MaterialFixture("subsurface", {{"eta", "0.9"}}), SceneError);
}

TEST(KdSubsurface, ReflectsItsColour) {
  const MaterialFixture m("kdsubsurface", {{"Kd", "0.2 0.5 0.7"}, {"mfp", "0.5 1 2"}});
  BssrdfStorage storage;
  const Bssrdf* b = m->bssrdf(tiltedSurface(), storage);
  ASSERT_TRUE(b);
  EXPECT_NEAR(radialIntegral([&](float r) { return b->profile(r).r; }, 100), 0.2, 0.005);
  EXPECT_NEAR(radialIntegral([&](float r) { return b->profile(r).g; }, 200), 0.5, 0.005);
  EXPECT_NEAR(radialIntegral([&](float r) { return b->profile(r).b; }, 400), 0.7, 0.007);
}

TEST(Disney, ScattersBelowWhereItHasADistance) {
  EXPECT_FALSE(MaterialFixture("disney", {})->scattersBelow());
  EXPECT_FALSE(
      MaterialFixture("disney", {{"scatterdistance", "1 1 1"}, {"thin", "true"}})->scattersBelow());
  EXPECT_TRUE(MaterialFixture("disney", {{"scatterdistance", "1 0 0"}})->scattersBelow());
  const MaterialFixture metal("disney", {{"scatterdistance", "1 1 1"}, {"metallic", "1"}});
  BssrdfStorage storage;
  EXPECT_FALSE(metal->bssrdf(tiltedSurface(), storage));
}

TEST(Mix, TheFirstMaterialScattersBelow) {
  const MaterialFixture first("mix", {{"namedmaterial1", "skin"}, {"namedmaterial2", "diffuse"}});
  BssrdfStorage storage;
  EXPECT_TRUE(first->scattersBelow());
  EXPECT_TRUE(first->bssrdf(tiltedSurface(), storage));
  MaterialFixture second("mix", {{"namedmaterial1", "diffuse"}, {"namedmaterial2", "skin"}});
  EXPECT_FALSE(second->scattersBelow());
  EXPECT_EQ(second.build().warnings.size(), 1u);
}

TEST(Bssrdfs, AreSafeWithTexturesThatAreNoNumbers) {
  for (const auto& e : materialRegistry().entries()) {
    if (e.name != "subsurface" && e.name != "kdsubsurface" && e.name != "disney") continue;
    for (const auto& d : e.schema.declarations()) {
      const bool colour = d.target == TargetType::RgbInput;
      if (!colour && d.target != TargetType::FloatInput) continue;
      TestParameters::List parameters;
      if (e.name == "disney") parameters.emplace_back("scatterdistance", "1 1 1");
      parameters.emplace_back(d.name, colour ? "@nan colour" : "@nan");
      const MaterialFixture m(e.name, parameters);
      BssrdfStorage storage;
      const Bssrdf* b = m->bssrdf(tiltedSurface(), storage);
      if (!b) continue;
      for (int channel = 0; channel < Bssrdf::kChannels; ++channel)
        for (const float u : {0.f, 0.2f, 0.7f, kOneMinusEpsilon}) {
          const auto r = b->sampleRadius(channel, u);
          if (!r) continue;
          ASSERT_TRUE(std::isfinite(*r) && *r >= 0) << e.name << " " << d.name;
          ASSERT_TRUE(b->profile(*r).isFinite()) << e.name << " " << d.name;
          ASSERT_TRUE(std::isfinite(b->pdfRadius(channel, *r)));
        }
    }
  }
}

}  // namespace
}  // namespace lampyris::test
