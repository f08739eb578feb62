// SPDX-License-Identifier: Apache-2.0
// Lights that look the same from afar count the same in the tree, whatever their kind.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "accelerators/light_bvh.h"
#include "light_maker.h"
#include "shapes/registry.h"

namespace lampyris::test {
namespace {

constexpr float kRadius = 1e-3f;
constexpr float kDistance = 2;

std::string threeTimes(float v) {
  const std::string s = fmt::format("{} ", v);
  return s + s + s;
}

struct Candidate {
  std::string name;
  std::unique_ptr<Light> light;
};

/// At the origin, with intensity 5 along +z.
class LightUnits : public testing::Test {
 protected:
  LightUnits() {
    maker_.build.textures.addRgb("one", [](const SurfaceInteraction&) { return Rgb(1); });
    Image white(3, 2, 3);
    for (float& v : white.data()) v = 1;
    const std::string map = testing::TempDir() + "units.pfm";
    writeImageFile(map, white);
    const std::string five = threeTimes(5);
    addSource("point", {{"I", five}});
    addSource("spot", {{"I", five}, {"to", "0 0 1"}});
    addSource("goniometric", {{"I", five}, {"mapname", map}});
    addSource("goniometric", {{"I", five}});
    addSource("projection", {{"I", five}, {"mapname", map}});
    addSource("projection", {{"I", five}, {"fov", "5"}});
    const float disk = kPi * sqr(kRadius);
    addEmitter("sphere", "radius", 5 / disk, {});
    addEmitter("sphere", "radius", 5 / disk, {{"twosided", "true"}});
    addEmitter("disk", "radius", 5 / disk, {});
    addEmitter("disk", "radius", 5 / disk, {{"twosided", "true"}});
    addEmitter("disk", "radius", 5 / disk, {{"filename", map}});
    addEmitter("sphere", "radius", 5 / disk, {{"filename", map}});
    addEmitter("disk", "radius", 5 / disk, {{"L", "@one"}, {"scale", threeTimes(5 / disk)}});
  }

  void addSource(const std::string& name, const TestParameters::List& list) {
    all_.push_back({name, maker_.make(name, list)});
  }
  void addEmitter(const std::string& shape, const char* size, float radiance,
                  TestParameters::List list) {
    const auto& plugin = shapeRegistry().get(shape, {});
    const TestParameters p(plugin.schema, {{size, fmt::format("{}", kRadius)}});
    shapes_.push_back(plugin.create(
        p.set(), ShapeContext{maker_.build.base(), maker_.build.textures, Transform(), false}));
    if (list.empty() || list[0].first != "L") list.push_back({"L", threeTimes(radiance)});
    all_.push_back({shape + " " + list[0].first, maker_.makeArea(*shapes_.back(), list)});
  }

  LightMaker maker_;
  std::vector<std::unique_ptr<Shape>> shapes_;
  std::vector<Candidate> all_;
};

TEST_F(LightUnits, EqualIntensityAndImportance) {
  const Vec3 from(0, 0, kDistance);
  const float luminance = Rgb(5).luminance();
  LightSampleContext wall;
  static const Bsdf surface{};
  wall.bsdf = &surface;
  wall.p = from;
  wall.n = wall.ns = wall.wo = {0, 0, -1};
  wall.reflects = true;
  for (const Candidate& c : all_) {
    // They do look the same: the irradiance is what the intensity says.
    double irradiance = 0;
    const int side = 16;
    for (int i = 0; i < side * side; ++i) {
      const Vec2 u = (Vec2(i % side, i / side) + 0.5f) / static_cast<float>(side);
      if (const auto s = c.light->sample(0, from, u))
        irradiance += static_cast<double>(s->radiance.luminance() / s->pdf) / (side * side);
    }
    EXPECT_NEAR(irradiance * kDistance * kDistance, luminance, 0.01 * luminance) << c.name;

    const LightBounds b = *c.light->bounds(0);
    EXPECT_NEAR(b.intensity, luminance, 0.01f * luminance) << c.name;
    const LightBVHAccel tree(std::vector<LightBVHInput>{{0, b}});
    const LinearLightBVHNode& node = tree.nodes()[0];
    const double expected = static_cast<double>(luminance) / (kDistance * kDistance);
    EXPECT_NEAR(LightReceiver(wall).importance(node), expected, 0.01 * expected) << c.name;
    EXPECT_NEAR(LightReceiver(from, 0.f).importance(node), expected, 0.01 * expected) << c.name;
  }
}

}  // namespace
}  // namespace lampyris::test
