// SPDX-License-Identifier: Apache-2.0
// Rays that leave lights: their densities, and that they carry the light which sample() finds.
#include <gtest/gtest.h>

#include <cmath>

#include "core/frame.h"
#include "core/sampling.h"
#include "light_maker.h"
#include "shapes/registry.h"
#include "support/statistics.h"

namespace lampyris::test {
namespace {

Vec2 pair(uint64_t seed, uint64_t i, uint32_t dimension) {
  return {uniform(seed, i, dimension), uniform(seed, i, dimension + 1)};
}

/// A disk in the scene on which light arrives.
struct Patch {
  Vec3 center{0}, n{0, 0, 1};
  float radius = 1;
};

/// Flux onto the patch's front by rays from the light, and by light that its points find.
void expectSameFlux(const Light& light, uint32_t element, const Patch& patch,
                    const std::string& what, int samples = 40'000) {
  const Frame frame = Frame::fromZ(patch.n);
  std::vector<double> differences;
  double sum = 0;
  for (uint64_t i = 0; i < static_cast<uint64_t>(samples); ++i) {
    double emitted = 0, received = 0;
    if (const auto s = light.sampleEmission(element, pair(3, i, 0), pair(3, i, 2))) {
      const EmissionPdf pdf = light.emissionPdf(element, s->n, s->w);
      EXPECT_NEAR(s->pdfPosition / pdf.position, 1, 1e-4f) << what;
      EXPECT_NEAR(s->pdfDirection / pdf.direction, 1, 1e-3f) << what;
      EXPECT_NEAR(length(s->w), 1, 1e-5f);
      const float cosine = s->n != Vec3(0) ? absDot(s->n, s->w) : 1.f;
      const float t = dot(patch.center - s->p, patch.n) / dot(s->w, patch.n);
      const bool hits =
          dot(s->w, patch.n) < 0 && t > 0 && distance(s->p + t * s->w, patch.center) < patch.radius;
      if (hits)
        emitted = static_cast<double>(s->radiance.g) * static_cast<double>(cosine) /
                  (static_cast<double>(s->pdfPosition) * static_cast<double>(s->pdfDirection));
    }
    const Vec2 d = patch.radius * sampleConcentricDisk(pair(3, i, 4));
    const Vec3 at = patch.center + d.x * frame.x + d.y * frame.y;
    if (const auto s = light.sample(element, at, pair(3, i, 6)))
      received = static_cast<double>(s->radiance.g * std::max(0.f, dot(s->wi, patch.n)) / s->pdf *
                                     kPi * sqr(patch.radius));
    differences.push_back(emitted - received);
    sum += received;
  }
  EXPECT_GT(sum, 0) << what;
  EXPECT_EQ(meanTest(differences, 0, 1e-4 * sum / samples), "") << what;
}

std::string testImage() {
  Image image(6, 4, 3);
  for (size_t i = 0; i < image.data().size(); ++i)
    image.data()[i] = uniform(2, i, 0) < 0.3f ? 0.f : uniform(2, i, 1);
  const std::string path = testing::TempDir() + "emission.pfm";
  writeImageFile(path, image);
  return path;
}

TEST(EmissionSampling, CarriesTheLightThatIsFound) {
  const std::string map = testImage();
  const Transform turned = Transform::rotate(30, {1, 0.3f, 0.2f});
  for (const auto& plugin : lightRegistry().entries())
    for (const bool mapped : {false, true})
      for (const Transform& t : {turned, turned * Transform::scale({1, 2, 0.7f})}) {
        TestParameters::List list;
        if (mapped && !plugin.schema.find("mapname")) continue;
        if (mapped) list.push_back({"mapname", map});
        LightMaker maker;
        const auto light = maker.make(plugin.name, list, t);
        light->prepare(Bounds3(Vec3(-3), Vec3(3)));
        // Lights that point somewhere point along z.
        const Vec3 ahead = normalize(t.vector({0, 0, 1}));
        const Patch patch{2.f * ahead, -ahead, 0.8f};
        expectSameFlux(*light, 0, patch, plugin.name + (mapped ? " with a map" : ""));
      }
}

TEST(EmissionSampling, AreaLightsCarryTheLightThatIsFound) {
  TestBuild build;
  for (const char* name : {"sphere", "disk", "cylinder"})
    for (const bool twoSided : {false, true}) {
      // The inside of a sphere sends rays that its other side would stop.
      if (twoSided && std::string(name) == "sphere") continue;
      const auto& plugin = shapeRegistry().get(name, {});
      const TestParameters none(plugin.schema, {});
      const auto shape =
          plugin.create(none.set(), ShapeContext{build.base(), build.textures,
                                                 Transform::rotate(30, {1, 0.3f, 0.2f}), false});
      LightMaker maker;
      const auto light =
          maker.makeArea(*shape, {{"L", "3 4 5"}, {"twosided", twoSided ? "true" : "false"}});
      expectSameFlux(*light, 0, {{1, 0.5f, 2}, normalize(Vec3(-0.3f, -0.2f, -1)), 0.6f}, name);
      if (twoSided) expectSameFlux(*light, 0, {{0.3f, 0, -2}, {0, 0, 1}, 0.9f}, name);
    }
}

TEST(EmissionSampling, DirectionsFollowTheirDensity) {
  for (const char* name : {"point", "goniometric", "spot", "infinite"}) {
    LightMaker maker;
    const auto light = maker.make(name, {}, Transform::rotate(70, {1, 0.3f, 0.2f}));
    light->prepare(Bounds3(Vec3(-3), Vec3(3)));
    DirectionTest test;
    test.samples = 50'000;
    test.sample = [&](const Vec2& u, float, Vec3& w) {
      const auto s = light->sampleEmission(0, {0.3f, 0.6f}, u);
      if (s) w = s->w;
      return s.has_value();
    };
    // Where nothing is emitted, nothing is drawn.
    test.pdf = [&](const Vec3& w) {
      const Vec3 from = w * 2.f;
      const bool lit = light->isInfinite() || light->sample(0, from, {0.5f, 0.5f}).has_value();
      return lit ? static_cast<double>(light->emissionPdf(0, Vec3(0), w).direction) : 0.;
    };
    test.subdivisions = 40;
    EXPECT_EQ(directionChiSquareTest(test), "") << name;
  }
}

}  // namespace
}  // namespace lampyris::test
