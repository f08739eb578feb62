// SPDX-License-Identifier: Apache-2.0
#include "integrators/scattering_point.h"

#include <gtest/gtest.h>

#include "../materials/material_cases.h"
#include "core/sampling.h"
#include "materials/lambert.h"
#include "materials/microfacet_reflection.h"
#include "support/statistics.h"

namespace lampyris::test {
namespace {

struct NoLoss {
  float operator()(float) const { return 1; }
};

/// A point whose normal is z.
struct Point {
  Bsdf bsdf;
  LightSampleContext context;

  explicit Point(float degrees) {
    SurfaceInteraction at;
    bsdf.reset(at);
    context.bsdf = &bsdf;
    context.wo = outgoing(bsdf, degrees);
  }
};

std::vector<Vec3> directions(size_t count) {
  std::vector<Vec3> all;
  for (uint64_t i = 0; i < count; ++i)
    all.push_back(sampleUniformSphere({uniform(1, i, 0), uniform(1, i, 1)}));
  return all;
}

std::vector<float> weights(const LightSampleContext& at, const std::vector<Vec3>& wi) {
  std::vector<float> all(wi.size());
  ScatteringPoint(at).weigh(wi, all);
  return all;
}

TEST(ScatteringPoint, WeighsWhatShapesTellExactly) {
  const std::vector<Vec3> wi = directions(1001);
  for (const float degrees : {0.f, 40.f, 85.f, 140.f})
    for (const float alpha : {0.05f, 0.3f, 1.f}) {
      Point p(degrees);
      p.bsdf.add<MicrofacetReflection<NoLoss>>(Rgb(0.4f), TrowbridgeReitz(alpha, alpha), NoLoss{});
      p.bsdf.add<LambertReflection>(Rgb(0.3f));
      const std::vector<float> found = weights(p.context, wi);
      for (size_t i = 0; i < wi.size(); ++i) {
        // By facets light passes shading normals' horizon, too, which no shape tells.
        if (wi[i].z * p.context.wo.z < 0) continue;
        const float exact = p.context.scattered(wi[i]).luminance();
        EXPECT_NEAR(found[i], exact, 1e-3f * exact + 1e-5f) << degrees << " " << alpha;
      }
    }
}

TEST(ScatteringPoint, WeighsExactlyWhereLobesTellNoShape) {
  const std::vector<Vec3> wi = directions(200);
  const std::vector<std::pair<std::string, TestParameters::List>> cases = {
      {"hair", {}}, {"glass", {{"uroughness", "0.2"}, {"vroughness", "0.2"}}}};
  for (const auto& [plugin, roughness] : cases) {
    Bsdf bsdf;
    MaterialFixture(plugin, roughness).evaluate(bsdf);
    LightSampleContext at;
    at.bsdf = &bsdf;
    at.wo = outgoing(bsdf, 30);
    const std::vector<float> found = weights(at, wi);
    for (size_t i = 0; i < wi.size(); ++i)
      EXPECT_EQ(found[i], at.scattered(wi[i]).luminance()) << plugin;
  }
}

TEST(ScatteringPoint, WeighsAboutAsEveryMaterialScatters) {
  const std::vector<Vec3> wi = directions(20'000);
  for (const MaterialCase& material : materialCases()) {
    const MaterialFixture fixture(material);
    Bsdf bsdf;
    fixture.evaluate(bsdf);
    if (bsdf.isSpecular()) continue;
    for (const float angle : {5.f, 40.f, 70.f}) {
      LightSampleContext at;
      at.bsdf = &bsdf;
      at.wo = outgoing(bsdf, angle);
      const std::vector<float> found = weights(at, wi);
      double total = 0, exactTotal = 0;
      std::vector<double> exact;
      for (size_t i = 0; i < wi.size(); ++i) {
        ASSERT_TRUE(found[i] >= 0 && std::isfinite(found[i])) << material.label();
        total += static_cast<double>(found[i]);
        exactTotal += exact.emplace_back(static_cast<double>(at.scattered(wi[i]).luminance()));
      }
      if (!(exactTotal > 0)) continue;
      double common = 0;
      for (size_t i = 0; i < wi.size(); ++i)
        common += std::min(static_cast<double>(found[i]) / total, exact[i] / exactTotal);
      // Shapes do not tell how much more light facets reflect at grazing angles.
      EXPECT_GT(common, 0.3) << material.label() << " " << angle;
    }
  }
}

}  // namespace
}  // namespace lampyris::test
