// SPDX-License-Identifier: Apache-2.0
// What every light of the registry promises (base/light.h).
#include <gtest/gtest.h>

#include <cmath>

#include "accelerators/light_bvh_importance.h"
#include "core/sampling.h"
#include "light_maker.h"
#include "support/statistics.h"

namespace lampyris::test {
namespace {

/// The plugin with its defaults, and with an image if it takes one.
std::vector<TestParameters::List> variants(const LightRegistry::Entry& plugin) {
  std::vector<TestParameters::List> all(1);
  if (!plugin.schema.find("mapname")) return all;
  Image image(6, 4, 3);
  for (size_t i = 0; i < image.data().size(); ++i)
    image.data()[i] = uniform(2, i, 0) < 0.5f ? 0.f : uniform(2, i, 1);
  const std::string path = testing::TempDir() + "contract.pfm";
  writeImageFile(path, image);
  all.push_back({{"mapname", path}});
  return all;
}

class LightContract : public testing::TestWithParam<std::string> {};

TEST_P(LightContract, SamplesBoundsAndDensitiesAgree) {
  const auto& plugin = lightRegistry().get(GetParam(), {});
  for (const auto& list : variants(plugin))
    for (const float scale : {1e-4f, 1.f, 1e4f}) {
      LightMaker maker;
      const Transform place = Transform::translate(scale * Vec3(1, 2, 3)) *
                              Transform::rotate(50, {3, 1, 2}) * Transform::scale(Vec3(scale));
      const auto light = maker.make(plugin.name, list, place);
      light->prepare(Bounds3(Vec3(-scale), Vec3(scale)));
      EXPECT_FALSE(light->power(0).isBlack());
      EXPECT_EQ(light->elementCount(), 1u);
      const auto bounds = light->bounds(0);
      EXPECT_EQ(bounds.has_value(), !light->isInfinite());
      int lit = 0;
      for (uint64_t i = 0; i < 2000; ++i) {
        const Vec3 from =
            scale * (Vec3(1, 2, 3) + 3 * uniform(4, i, 0) *
                                         sampleUniformSphere({uniform(4, i, 1), uniform(4, i, 2)}));
        const Vec2 u(uniform(4, i, 3), uniform(4, i, 4));
        const auto s = light->sample(0, from, u);
        if (!s) continue;
        ++lit;
        EXPECT_GT(s->pdf, 0);
        EXPECT_TRUE(s->radiance.isFinite() && s->radiance.maxComponent() > 0);
        EXPECT_NEAR(length(s->wi), 1, 1e-5f);
        if (light->isDelta()) {
          EXPECT_EQ(s->pdf, 1);
          EXPECT_EQ(light->pdfEscape(s->wi), 0);
        } else {
          EXPECT_EQ(s->pdf, light->pdfEscape(s->wi));
          EXPECT_EQ(s->radiance, light->escaped(s->wi));
        }
        if (!bounds) {
          EXPECT_GT(light->irradianceEstimate(s->wi, false), 0);
          continue;
        }
        EXPECT_LT(distance(from + s->distance * s->wi, s->p), 1e-4f * s->distance + 1e-5f * scale);
        const LinearLightBVHNode node(bounds->box, EmissionCone::of(*bounds), bounds->intensity,
                                      true, 0);
        EXPECT_GT(LightReceiver(from, 0.f).importance(node), 0);
      }
      EXPECT_GT(lit, 20);
    }
}

std::vector<std::string> names() {
  std::vector<std::string> all;
  for (const auto& e : lightRegistry().entries()) all.push_back(e.name);
  return all;
}
INSTANTIATE_TEST_SUITE_P(All, LightContract, testing::ValuesIn(names()));

}  // namespace
}  // namespace lampyris::test
