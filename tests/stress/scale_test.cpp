// SPDX-License-Identifier: Apache-2.0
/// Scenes of any size, anywhere, with lights of any power: the same image.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "stress/stress.h"

namespace lampyris::test {
namespace {

const std::string kOneBounce = "\"integer maxdepth\" 1";

std::vector<Place> places() {
  std::vector<Place> all;
  for (const double scale : {1e-6, 1e-3, 1., 1e3, 1e6}) {
    all.push_back({scale, DVec3(0)});
    all.push_back({scale, DVec3(1e5, -7e4, 4e4)});
  }
  return all;
}

/// Lights of all kinds of shape, and a strong lamp that a ball hides.
DScene lights(double power) {
  DScene s;
  s.addQuad({-1.5, -0.5, 2}, {0, 1, 0}, {1, 0, 0}, 2 * power);
  s.addQuad({1, -0.5, 0.5}, {0, 0, 1}, {0, 1, 0}, power);
  s.balls.push_back({{0.5, 1.5, 1.25}, 0.25, 4 * power});
  s.balls.push_back({{-1.25, -1.25, 0.75}, 0.5, 0});
  s.lamps.push_back({{-0.5, 0.75, 1}, power});
  s.lamps.push_back({{-2.5, -2.5, 1.5}, 50 * power});
  return s;
}

TEST(Scale, AnyPlaceAndSizeGivesTheSameLight) {
  const DScene scene = lights(1);
  for (const Place& place : places()) {
    SCOPED_TRACE(testing::PrintToString(place));
    const DScene placed = scene.placed(place);
    const Expected expected = expectedRadiance(placed, place);
    EXPECT_LT(expected.slack, 0.02 * expected.radiance);
    for (const TinyView& view : directViews(kOneBounce) + lightSamplerViews(kOneBounce))
      expectRadiance(view, placed.text(view, place), expected, 64);
    TinyScene any(placed.text({}, place));
    expectLightContract(any);
  }
}

TEST(Scale, LightGoesOnBouncing) {
  for (const Place& place : places()) {
    SCOPED_TRACE(testing::PrintToString(place));
    for (TinyView view : pathViews("\"integer maxdepth\" 8")) {
      // Half of the light goes on each time: 1 + 1/2 + 1/4 …
      const DVec3 c = place(DVec3(0)), front = place({0, 0, -1});
      view.camera = R"("perspective" "float fov" 60)";
      view.resolution = 4;
      view.lookAt = fmt::format("{:.9g} {:.9g} {:.9g}  {:.9g} {:.9g} {:.9g}  0 1 0", c.x, c.y, c.z,
                                front.x, front.y, front.z);
      const std::string world =
          fmt::format("Translate {:.9g} {:.9g} {:.9g}\n", c.x, c.y, c.z) + matte(0.5f) +
          "AreaLightSource \"diffuse\" \"rgb L\" [1 1 1]\nReverseOrientation\n" +
          fmt::format("Shape \"sphere\" \"float radius\" {:.9g}\n", place.length(2));
      expectRadiance(view, tinyScene(view, world), {2 - std::exp2(-8), 2e-3}, 64);
    }
  }
}

/// A lamp, the floor and the camera in one medium: what is left of the light after both ways.
TEST(Scale, MediaDimByTheirUnitOfLength) {
  for (const Place& place : places()) {
    SCOPED_TRACE(testing::PrintToString(place));
    DScene s;
    s.lamps.push_back({{1, 0, 2}, 3});
    const DScene placed = s.placed(place);
    Expected expected = expectedRadiance(placed, place);
    const double sigma = 0.5, dimmed = std::exp(-sigma * (s.eye + std::sqrt(5.)));
    // Rounded points are as many steps off as make a difference to this as well.
    const double steps = glm::length(place.rounding(DVec3(0))) / place.scale;
    expected = {dimmed * expected.radiance,
                dimmed * (expected.slack + 4 * sigma * steps * expected.radiance)};
    const std::string density = fmt::format("{0:.9g} {0:.9g} {0:.9g}", sigma / place.scale);
    const std::string medium =
        "MakeNamedMedium \"fog\" \"string type\" \"homogeneous\" \"rgb sigma_s\" [0 0 0] "
        "\"rgb sigma_a\" [" +
        density + "]\nMediumInterface \"\" \"fog\"\n";
    for (const TinyView& view : pathViews(kOneBounce)) {
      std::string text = placed.text(view, place);
      text.insert(text.find("Camera"), medium);
      text.insert(text.find("LightSource"), "MediumInterface \"\" \"fog\"\n");
      if (TinyScene(text).job().integrator->rendersMedia())
        expectRadiance(view, text, expected, 16);
    }
  }
}

/// A strong lamp below the floor, which some distributions draw all the time, and an emitter 10²⁴
/// times weaker, which rays find.
TEST(Power, WeakEmittersBesideStrongOnes) {
  DScene s;
  s.eye = 1;
  s.addQuad({-2, -2, 2}, {0, 4, 0}, {4, 0, 0}, 1e-12);
  const Place place;
  const Expected expected = expectedRadiance(s.placed(place), place);
  DScene both = s;
  both.lamps.push_back({{0, 0, -3}, 1e12});
  for (const TinyView& view : lightSamplerViews(kOneBounce))
    expectRadiance(view, both.placed(place).text(view, place), expected, 256);
}

TEST(Power, AnyPowerGivesItsLight) {
  for (const double watts : {1e-12, 1e-6, 1., 1e6, 1e12}) {
    SCOPED_TRACE(watts);
    const Place place;
    const DScene placed = lights(watts / 30).placed(place);
    const Expected expected = expectedRadiance(placed, place);
    for (const TinyView& view : directViews(kOneBounce) + lightSamplerViews(kOneBounce))
      expectRadiance(view, placed.text(view, place), expected, 64);
    TinyScene any(placed.text({}, place));
    expectLightContract(any);
  }
}

}  // namespace
}  // namespace lampyris::test
