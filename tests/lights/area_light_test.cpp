// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "light_maker.h"
#include "shapes/registry.h"
#include "support/quad_shape.h"
#include "support/statistics.h"

namespace lampyris::test {
namespace {

std::vector<double> irradianceSamples(const Light& light, const Vec3& p, const Vec3& n, int count) {
  std::vector<double> values;
  for (int i = 0; i < count; ++i) {
    const auto at = static_cast<uint64_t>(i);
    const auto s = light.sample(0, p, {uniform(1, at, 0), uniform(1, at, 1)});
    values.push_back(s ? static_cast<double>(s->radiance.r * std::max(dot(n, s->wi), 0.f) / s->pdf)
                       : 0);
  }
  return values;
}

/// Every sample's pdf is what pdfHit says of the point, and the point emits the sample's radiance.
void checkConsistency(const Light& light, const Vec3& from) {
  for (uint64_t i = 0; i < 500; ++i) {
    const auto s = light.sample(0, from, {uniform(5, i, 0), uniform(5, i, 1)});
    if (!s) continue;
    SurfaceInteraction hit;
    hit.p = s->p;
    hit.n = hit.shading.n = s->n;
    EXPECT_NEAR(light.pdfHit(0, from, hit), s->pdf, 2e-3f * s->pdf);
    EXPECT_EQ(light.emitted(hit, -s->wi), s->radiance);
    EXPECT_NEAR(length(s->wi), 1, 1e-5);
    EXPECT_NEAR(distance(from + s->distance * s->wi, s->p), 0, 1e-4f * s->distance);
  }
}

class ShapeMaker {
 public:
  std::unique_ptr<Shape> make(const std::string& name, const TestParameters::List& list,
                              const Transform& objectToWorld = {}) {
    const auto& plugin = shapeRegistry().get(name, {});
    const TestParameters p(plugin.schema, list);
    return plugin.create(p.set(),
                         ShapeContext{build_.base(), build_.textures, objectToWorld, false});
  }

 private:
  TestBuild build_;
};

TEST(DiffuseLight, SphereFormFactor) {
  ShapeMaker shapes;
  LightMaker maker;
  const auto sphere = shapes.make("sphere", {{"radius", "2"}}, Transform::translate({0, 0, 5}));
  const auto light = maker.makeArea(*sphere, {{"L", "3 3 3"}});
  const double expected = 3.14159265358979 * 3 * 4 / 25;
  EXPECT_EQ(meanTest(irradianceSamples(*light, Vec3(0), {0, 0, 1}, 20'000), expected, 1e-4), "");
  checkConsistency(*light, Vec3(0));
  EXPECT_NEAR(light->power(0).r, 3 * kPi * 16 * kPi, 1e-2);
}

TEST(DiffuseLight, DiskFormFactor) {
  ShapeMaker shapes;
  LightMaker maker;
  const auto disk = shapes.make("disk", {{"radius", "2"}, {"height", "3"}});
  const auto light = maker.makeArea(*disk, {{"L", "5 5 5"}, {"twosided", "true"}});
  const double expected = 3.14159265358979 * 5 * 4 / (4 + 9);
  EXPECT_EQ(meanTest(irradianceSamples(*light, Vec3(0), {0, 0, 1}, 40'000), expected, 1e-4), "");
  checkConsistency(*light, {0.5f, 0.25f, -1});
}

TEST(DiffuseLight, RectangleFormFactor) {
  LightMaker maker;
  const QuadShape quad({{Vec3(-1, -2, 2), {0, 4, 0}, {2, 0, 0}}});  // normal −z
  const auto light = maker.makeArea(quad, {});
  const double x = 0.5, y = 1;  // half edges / distance
  const auto part = [](double a, double b) {
    return a / std::sqrt(1 + a * a) * std::atan(b / std::sqrt(1 + a * a));
  };
  const double expected = 4 * 0.5 * (part(x, y) + part(y, x));
  EXPECT_EQ(meanTest(irradianceSamples(*light, Vec3(0), {0, 0, 1}, 40'000), expected, 1e-4), "");
  checkConsistency(*light, {0.3f, -1, 0.5f});
  EXPECT_FALSE(light->sample(0, {0, 0, 3}, {0.5f, 0.5f})) << "behind a one-sided emitter";
  EXPECT_FALSE(light->sample(0, {0, 0, 2}, {0.5f, 0.5f})) << "in its plane";
  EXPECT_FLOAT_EQ(light->power(0).r, 8 * kPi);
  const LightBounds b = *light->bounds(0);
  EXPECT_EQ(b.axis, Vec3(0, 0, -1));
  EXPECT_FLOAT_EQ(b.intensity, 8 * Rgb(1).luminance());
  EXPECT_EQ(b.cosThetaE, 0);
  EXPECT_FALSE(b.twoSided);
}

TEST(DiffuseLight, TwoSidedEmitsBothWays) {
  LightMaker maker;
  const QuadShape quad({{Vec3(-1, -1, 0), {2, 0, 0}, {0, 2, 0}}});
  const auto one = maker.makeArea(quad, {{"scale", "2 2 2"}});
  const auto two = maker.makeArea(quad, {{"twosided", "true"}, {"nsamples", "7"}}, "area");
  SurfaceInteraction at;
  at.n = {0, 0, 1};
  const Vec3 up = normalize(Vec3(1, 0, 1));
  EXPECT_EQ(one->emitted(at, up).r, 2);
  EXPECT_TRUE(one->emitted(at, -up).isBlack());
  EXPECT_EQ(two->emitted(at, -up).r, 1);
  EXPECT_FALSE(one->sample(0, {0, 0, -1}, {0.2f, 0.2f}));
  EXPECT_TRUE(two->sample(0, {0, 0, -1}, {0.2f, 0.2f}));
  EXPECT_FLOAT_EQ(two->power(0).r, one->power(0).r);
  EXPECT_TRUE(two->bounds(0)->twoSided);
  EXPECT_EQ(two->samples(), 7);
}

TEST(DiffuseLight, ElementsAreLights) {
  LightMaker maker;
  const QuadShape quads({{Vec3(0), {1, 0, 0}, {0, 1, 0}}, {Vec3(5), {1, 0, 0}, {0, 0, 0}}});
  for (const auto& plugin : areaLightRegistry().entries()) {
    const auto light = maker.makeArea(quads, {}, plugin.name);
    EXPECT_EQ(light->elementCount(), 2u);
    EXPECT_FALSE(light->isDelta());
    EXPECT_TRUE(light->power(1).isBlack()) << "no area";
    EXPECT_FALSE(light->sample(1, {0, 0, 9}, {0.5f, 0.5f}));
    EXPECT_EQ(light->bounds(1)->intensity, 0);
  }
}

}  // namespace
}  // namespace lampyris::test
