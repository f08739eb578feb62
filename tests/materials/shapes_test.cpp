// SPDX-License-Identifier: Apache-2.0
// What lobes tell of where they scatter.
#include <gtest/gtest.h>

#include <array>

#include "material_cases.h"
#include "support/statistics.h"

namespace lampyris::test {
namespace {

/// Sums of the shapes' albedos on wo's side and on the other.
std::array<float, 2> claimed(const Bsdf& bsdf, const Vec3& woLocal) {
  std::array<float, 2> sums{};
  for (size_t i = 0; i < bsdf.lobeCount(); ++i) {
    std::array<LobeShape, Lobe::kMaxShapes> shapes;
    const size_t n = bsdf.lobe(i).shapes(woLocal, shapes);
    EXPECT_LE(n, shapes.size());
    for (size_t k = 0; k < n; ++k) {
      EXPECT_TRUE(shapes[k].albedo >= 0 && shapes[k].albedo < 10);
      EXPECT_TRUE(shapes[k].alpha > 0 && shapes[k].eta > 0);
      sums[shapes[k].transmitted] += shapes[k].albedo;
    }
  }
  return sums;
}

TEST(LobeShapes, CoverWhereMaterialsScatter) {
  for (const MaterialCase& material : materialCases()) {
    const MaterialFixture fixture(material);
    Bsdf bsdf;
    fixture.evaluate(bsdf);
    for (const float angle : {5.f, 40.f, 80.f, 110.f, 170.f}) {
      const Vec3 wo = outgoing(bsdf, angle);
      const auto sums = claimed(bsdf, bsdf.frame().toLocal(wo));
      std::array<double, 2> scattered{};
      const int draws = 2000;
      for (uint64_t i = 0; i < draws; ++i) {
        const auto s = bsdf.sample(wo, uniform(1, i, 0), Vec2(uniform(1, i, 1), uniform(1, i, 2)));
        if (!s || s->isSpecular()) continue;
        const bool transmitted =
            dot(wo, bsdf.geometricNormal()) * dot(s->wi, bsdf.geometricNormal()) < 0;
        scattered[transmitted] +=
            static_cast<double>(s->f.luminance() * bsdf.absCosTheta(s->wi) / s->pdf) / draws;
      }
      // Radiance grows by refraction into the thinner medium; Fresnel's term is that of the
      // macroscopic angle (where that is total, facets let some pass). The order of magnitude is
      // what importance needs.
      for (const size_t side : {0, 1}) {
        const auto claim = static_cast<double>(sums[side]);
        if (scattered[side] > 0.05) {
          EXPECT_GT(claim, 0.02 * scattered[side]) << material.label() << " " << angle;
        }
        if (claim > 0.02) {
          EXPECT_GT(scattered[side], 0.05 * claim) << material.label() << " " << angle;
        }
      }
    }
  }
}

TEST(LobeShapes, SpecularLobesHaveNone) {
  Bsdf bsdf;
  MaterialFixture("mirror", {}).evaluate(bsdf);
  std::array<LobeShape, Lobe::kMaxShapes> shapes;
  EXPECT_EQ(bsdf.lobe(0).shapes({0, 0, 1}, shapes), 0u);
}

}  // namespace
}  // namespace lampyris::test
