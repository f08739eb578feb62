// SPDX-License-Identifier: Apache-2.0
/// Light along surfaces, lights on them and in glass, needles, and surfaces in the same place.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "stress/double_bsdf.h"
#include "stress/stress.h"

namespace lampyris::test {
namespace {

const std::string kOneBounce = "\"integer maxdepth\" 1";

/// The floor's middle by all means of direct light, at some sizes.
void expectDirectLight(const DScene& scene, const Views& views, double slack = 0, int cells = 200) {
  for (const double scale : {1e-6, 1., 1e6}) {
    const Place place{scale, DVec3(0)};
    SCOPED_TRACE(testing::PrintToString(place));
    const DScene placed = scene.placed(place);
    Expected expected = expectedRadiance(placed, place, cells);
    expected.slack += slack * expected.radiance;
    for (const TinyView& view : views) expectRadiance(view, placed.text(view, place), expected, 64);
    TinyScene any(placed.text({}, place));
    expectLightContract(any);
  }
}
Views allViews() { return directViews(kOneBounce) + lightSamplerViews(kOneBounce); }

TEST(Grazing, LampsJustAboveTheHorizon) {
  for (const double height : {1e-1, 1e-3, 1e-6, 1e-9, 0.}) {
    SCOPED_TRACE(height);
    DScene s;
    s.lamps.push_back({{2, 0.5, height}, 1});
    expectDirectLight(s, allViews(), 1e-4);
  }
}

TEST(Grazing, EmittersAcrossTheHorizonAndInIt) {
  DScene across;  // stands on the floor, and goes on below it
  across.addQuad({1, -1, -1}, {0, 0, 2}, {0, 2, 0}, 3);
  expectDirectLight(across, allViews());
  DScene low;
  low.addQuad({1, -0.5, 1e-5}, {0, 0, 1e-4}, {0, 1, 0}, 3e4);
  expectDirectLight(low, allViews(), 2e-3);
  DScene edgeOn;  // in the plane through the point that it would light
  edgeOn.addQuad({0.5, 0, 0.5}, {1, 0, 1}, {1, 0, 2}, 3);
  expectDirectLight(edgeOn, allViews());
}

TEST(LightsOnSurfaces, BallsSunkIntoTheFloorAndTouchingIt) {
  for (const double height : {0., 0.5, 0.5 + 1e-6}) {
    SCOPED_TRACE(height);
    DScene s;
    s.balls.push_back({{1.25, 0, height}, 0.5, 2});
    expectDirectLight(s, allViews(), 1e-3);
  }
}

TEST(LightsOnSurfaces, PointsNextToAnEmittersEdge) {
  for (const double away : {1e-1, 1e-3, 1e-5}) {
    SCOPED_TRACE(away);
    DScene s;  // a wall of light that begins beside the point: half of the sky, but for its end
    s.addQuad({away, -2, 0}, {0, 0, 2}, {0, 4, 0}, 1);
    // By the form factor of a rectangle in a perpendicular plane, doubled: two of width 2.
    const double h = 2 / away, w = 2 / away;
    const double f =
        (std::atan(w) - std::atan(w / std::sqrt(1 + h * h)) / std::sqrt(1 + h * h)) / M_PI;
    for (const TinyView& view : allViews())
      expectRadiance(view, s.placed({}).text(view, {}), {0.5 * f, 1e-4}, 64);
  }
}

TEST(LightsOnSurfaces, LampsWhereTheyLight) {
  DScene s;
  s.lamps.push_back({DVec3(0), 1});
  s.lamps.push_back({{0, 0, 1e-7}, 1e-15});
  for (const TinyView& view : allViews()) {
    TinyScene scene(s.placed({}).text(view, {}));
    scene.render(16);
    EXPECT_EQ(scene.badSamples(), 0);
    for (const Rgb& c : scene.pixels()) EXPECT_TRUE(c.isFinite());
  }
}

TEST(Needles, EmittersOfNeedlesShineAsOne) {
  DScene whole;
  whole.triangles.push_back({{-1, 1, 1.5}, {1, 1, 1.5}, {0, -1, 1.5}, 2});
  const Expected expected = expectedRadiance(whole, {});
  for (const int needles : {7, 600}) {
    DScene fan;  // some of them without area
    fan.eye = 0.5;
    for (int i = 0; i < needles; ++i) {
      const auto base = [&](int k) { return DVec3(Vec3(2. * k / needles - 1, 1, 1.5)); };
      fan.triangles.push_back({base(i), base(i + 1), {0, -1, 1.5}, 2});
      if (i % 100 == 0) fan.triangles.push_back({base(i), base(i), {0, -1, 1.5}, 2});
    }
    for (const TinyView& view : allViews())
      expectRadiance(view, fan.text(view, {}), expected, needles < 10 ? 64 : 16);
    TinyScene any(fan.text({}, {}));
    expectLightContract(any);
  }
}

TEST(Needles, OneNeedleAlone) {
  DScene s;
  s.triangles.push_back({{-1, 1, 1.5}, {1, 1, 1.5}, {0, 1 - 1e-6, 1.5}, 1e6});
  expectDirectLight(s, allViews(), 1e-3, 400);
}

TEST(Needles, FloorsOfThemHaveNoCracks) {
  // A fan of needles under a sun; what shines from below is a million times as bright. Their
  // corners come in any order, so that neighbours see the edge between them differently.
  constexpr int kNeedles = 2000;
  std::string points = "0 -4 0 ", indices;
  for (int i = 0; i <= kNeedles; ++i) {
    points += fmt::format("{:.9g} 3 0 ", 8. * i / kNeedles - 4);
    std::array<int, 3> needle{0, i, i + 1};
    std::rotate(needle.begin(), needle.begin() + i % 3, needle.end());
    if (i > 0) indices += fmt::format("{} ", fmt::join(needle, " "));
  }
  const std::string world =
      "LightSource \"distant\" \"point from\" [0 0 1] \"point to\" [0 0 0]\n" + matte(0.5f) +
      "Shape \"trianglemesh\" \"point P\" [" + points + "] \"integer indices\" [" + indices +
      "]\n" +
      "AttributeBegin\nTranslate 0 0 -1\nAreaLightSource \"diffuse\" \"rgb L\" [1e6 "
      "1e6 1e6]\n" +
      square(5) + "AttributeEnd\n";
  for (TinyView view : pathViews(kOneBounce)) {
    view.lookAt = "41 -57 50  0 0 0  0 0 1";
    view.camera = R"("perspective" "float fov" 0.6)";
    view.resolution = 32;
    const std::string scene = tinyScene(view, world);
    expectRadiance(view, scene, {0.5 / M_PI, 1e-6}, 4);
    // One crack is lost in the noise that it makes.
    TinyScene again(scene);
    again.render(64);
    const std::vector<double> pixels = again.greens();
    EXPECT_LT(*std::max_element(pixels.begin(), pixels.end()), 1);
  }
}

TEST(Coincident, SurfacesInOnePlaceAreOne) {
  for (const Place& place : {Place{}, Place{1e-6, DVec3(0)}, Place{1, DVec3(1e5, 7e4, -4e4)}}) {
    SCOPED_TRACE(testing::PrintToString(place));
    DScene s;
    s.lamps.push_back({{1, 0, 1}, 3});
    const DScene placed = s.placed(place);
    const Expected expected = expectedRadiance(placed, place);
    for (const TinyView& view : allViews()) {
      std::string text = placed.text(view, place);
      const size_t from = text.find("Shape"), to = text.find("Material", from);
      const std::string both = text.substr(from, to - from);
      text.insert(to, both + both);
      expectRadiance(view, text, expected, 4);
    }
  }
}

/// A hair below the ceiling an emitter shines as if there were none. In its very plane, which of
/// the two a ray meets is anyone's guess: light is lost, but none is made.
TEST(Coincident, EmittersInTheCeiling) {
  for (const double below : {1e-6, 0.}) {
    DScene s;
    s.eye = 1;
    s.addQuad({-1, -1, 2 - below}, {0, 2, 0}, {2, 0, 0}, 2);
    const Expected expected = expectedRadiance(s.placed({}), {});
    s.addQuad({-3, -3, 2}, {0, 6, 0}, {6, 0, 0}, 0);
    for (const TinyView& view : allViews())
      expectRadiance(
          view, s.placed({}).text(view, {}),
          below > 0 ? expected : Expected{0.75 * expected.radiance, 0.25 * expected.radiance}, 64);
  }
}

/// A ball of light in the middle of a ball of glass, far from a matte plane that faces it. All its
/// rays have an impact parameter b below its radius r, and n b is kept: from outside it looks like
/// a ball of radius η r, (1 − F) / η² as bright.
TEST(LightsInGlass, ShineThroughIt) {
  const double eta = 1.5, r = 0.375, glass = 1, distance = 2;
  double sum = 0;
  constexpr int kSteps = 100'000;
  for (int i = 0; i < kSteps; ++i) {
    const double b2 = r * r * (i + 0.5) / kSteps;
    sum += 1 - dielectricFresnel(std::sqrt(1 - eta * eta * b2 / (glass * glass)), eta);
  }
  const double irradiance = M_PI * sum / kSteps * r * r / (distance * distance);
  for (const Place& place :
       {Place{}, Place{1e-6, DVec3(0)}, Place{1e6, DVec3(0)}, Place{1, DVec3(1e5, 7e4, -4e4)}}) {
    SCOPED_TRACE(testing::PrintToString(place));
    const DVec3 middle = place(DVec3(0)), eye = place({0, 0, 0.5});
    for (TinyView view : pathViews("\"integer maxdepth\" 4")) {
      view.lookAt = fmt::format("{:.9g} {:.9g} {:.9g}  {:.9g} {:.9g} {:.9g}  0 1 0", eye.x, eye.y,
                                eye.z, middle.x, middle.y, middle.z);
      view.camera = fmt::format("\"orthographic\" \"float screenwindow\" [-{0} {0} -{0} {0}]",
                                place.length(1e-6));
      const std::string world =
          fmt::format("Translate {:.9g} {:.9g} {:.9g}\n", middle.x, middle.y, middle.z) +
          matte(0.5f) + square(place.length(4)) +
          fmt::format(
              "Translate 0 0 {:.9g}\nMaterial \"glass\" \"float eta\" 1.5\n"
              "Shape \"sphere\" \"float radius\" {:.9g}\n{}"
              "AreaLightSource \"diffuse\" \"rgb L\" [1 1 1]\n"
              "Shape \"sphere\" \"float radius\" {:.9g}\n",
              place.length(distance), place.length(glass), matte(0), place.length(r));
      expectRadiance(view, tinyScene(view, world), {0.5 / M_PI * irradiance, 0}, 512);
    }
  }
}

}  // namespace
}  // namespace lampyris::test
