// SPDX-License-Identifier: Apache-2.0
/// Every way to lose a sample is counted (core/rejections.h), and shows in the statistics.
#include "core/rejections.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "film/filter_registry.h"
#include "film/light_image.h"
#include "integrators/light_connection.h"
#include "integrators/path_densities.h"
#include "integrators/registry.h"
#include "integrators/volume_path.h"
#include "support/tiny_scenes.h"

namespace lampyris::test {
namespace {

/// How much one count grows while something is done; no other may.
template <class Do>
uint64_t counted(Rejection what, const Do& act) {
  const RejectionCounts before = rejectionCounts();
  act();
  const RejectionCounts after = rejectionCounts();
  for (size_t i = 0; i < kRejectionCount; ++i)
    EXPECT_TRUE(after[i] == before[i] || i == static_cast<size_t>(what))
        << nameOf(static_cast<Rejection>(i));
  return after[static_cast<size_t>(what)] - before[static_cast<size_t>(what)];
}

/// Renders; returns what the statistics say.
double reported(Rejection what, const TinyView& view, const std::string& world,
                uint64_t samples = 4) {
  TinyScene scene(tinyScene(view, world));
  scene.render(samples);
  return scene.statistics().value(kRejectionSection, nameOf(what));
}

/// Scatters up, with a density of choice.
class BadLobe final : public Lobe {
 public:
  explicit BadLobe(float pdf) : Lobe(kReflection | kDiffuse), pdf_(pdf) {}
  Rgb f(const Vec3&, const Vec3&) const override { return Rgb(1); }
  float pdf(const Vec3&, const Vec3&) const override { return pdf_; }
  std::optional<LobeSample> sample(const Vec3&, float, const Vec2&) const override {
    return LobeSample{Vec3(0, 0, 1), Rgb(1), pdf_, flags, 1};
  }
  float albedo(const Vec3&) const override { return 1; }

 private:
  float pdf_;
};

/// Shines from above, with a density of choice.
class BadLight final : public Light {
 public:
  explicit BadLight(float pdf) : pdf_(pdf) {}
  bool isDelta() const override { return false; }
  std::optional<LightSample> sample(uint32_t, const Vec3&, const Vec2&) const override {
    LightSample s;
    s.radiance = Rgb(1);
    s.wi = Vec3(0, 0, 1);
    s.pdf = pdf_;
    return s;
  }
  float pdfHit(uint32_t, const Vec3&, const SurfaceInteraction&) const override { return pdf_; }
  Rgb power(uint32_t) const override { return Rgb(1); }
  std::optional<LightBounds> bounds(uint32_t) const override { return std::nullopt; }

 private:
  float pdf_;
};

class OneLight final : public LightDistribution {
 public:
  std::optional<SampledLight> sample(const LightSampleContext&, float) const override {
    return SampledLight{0, 1};
  }
  float pmf(const LightSampleContext&, LightId) const override { return 1; }
};

constexpr float kBadDensities[] = {0, kInfinity, NAN};

TEST(Rejections, DensitiesOfScattering) {
  for (const float pdf : kBadDensities) {
    Bsdf bsdf;
    bsdf.reset({});
    bsdf.add<BadLobe>(pdf);
    EXPECT_EQ(counted(Rejection::ScatteringDensity,
                      [&] {
                        EXPECT_FALSE(bsdf.sample({0, 0, 1}, 0.5f, Vec2(0.5f)));
                      }),
              1u);
  }
}

TEST(Rejections, DensitiesOfLights) {
  for (const float pdf : kBadDensities) {
    const BadLight light(pdf);
    Scene scene;
    scene.lightTable.add(&light);
    EXPECT_EQ(counted(Rejection::LightDensity,
                      [&] { EXPECT_FALSE(lightArriving(scene, 0, Vec3(0), Vec2(0.5f))); }),
              1u);
  }
}

TEST(Rejections, LightFromWhereThePointIs) {
  EXPECT_EQ(
      reported(Rejection::LightRadiance, {},
               "LightSource \"point\" \"rgb I\" [1e35 1e35 1e35] \"point from\" [0 0 0.001]\n" +
                   matte(0.5f) + square(1)),
      4 * 64);
}

TEST(Rejections, PathsThatAreNotFinite) {
  TinyView view;
  view.integrator = "\"bdpt\"";
  const std::string lamp =
      "LightSource \"point\" \"rgb I\" [2e37 2e37 2e37] \"point from\" [0 0 1e10]\n";
  EXPECT_GE(reported(Rejection::PathWeight, view, lamp + lamp + matte(0.5f) + square(1)), 4 * 64);
}

TEST(Rejections, WeightsThatAreNoNumbers) {
  const BadLight light(NAN);
  Scene scene;
  scene.lightTable.add(&light);
  const EmitterTable emitters(scene.lightTable);
  const OneLight distribution;
  TinyScene any(tinyScene({}, matte(1) + square(1)));
  const PathDensities densities(scene, *any.job().camera, emitters, &distribution, 64);
  PathVertex lamp, surface, camera;
  lamp.kind = PathVertex::Kind::Light;
  lamp.light = 0;
  lamp.forward = 1;
  lamp.at.p = Vec3(0, 0, 2);
  surface.forward = 1;
  camera.kind = PathVertex::Kind::Camera;
  camera.at.p = Vec3(1, 0, 1);
  const WholePath path{{&lamp, &surface, &camera}, 0};
  EXPECT_EQ(counted(Rejection::MisWeight, [&] { EXPECT_EQ(densities.weight(path, 0), 0); }), 1u);
}

TEST(Rejections, SurfacesWithoutAMaterialThatNeverEnd) {
  std::string world = "LightSource \"infinite\"\nMaterial \"\"\n";
  for (int i = 0; i < 1100; ++i) world += "Translate 0 0 0.001\n" + square(1);
  for (const auto& e : integratorRegistry().entries()) {
    TinyView view;
    view.integrator = "\"" + e.name + "\"";
    if (e.schema.find("bootstrapsamples"))
      view.integrator += " \"integer bootstrapsamples\" 64 \"integer maxdepth\" 0";
    EXPECT_GE(reported(Rejection::Interfaces, view, world, 1), 64) << e.name;
  }
}

TEST(Rejections, ProbesThatNeverEnd) {
  std::string world = "LightSource \"infinite\"\nMaterial \"subsurface\" \"float scale\" 1\n";
  for (int i = 0; i < 1100; ++i) world += "Translate 0 0 0.00001\n" + square(1);
  EXPECT_GT(reported(Rejection::ProbeHits, {}, world), 0);
}

TEST(Rejections, WhatGuidesAreNotTaught) {
  GuidedMemory memory(nullptr);
  memory.turns.push_back({{}, Rgb(1e-30f), Rgb()});
  EXPECT_EQ(counted(Rejection::LearningSample, [&] { memory.finish(Rgb(1e30f)); }), 1u);
  EXPECT_TRUE(memory.samples.empty());
}

TEST(Rejections, OfTheFilm) {
  TinyScene scene(tinyScene({}, matte(1) + square(1)));
  scene.film().openLightImage(1);
  EXPECT_EQ(counted(Rejection::Splat,
                    [&] { EXPECT_FALSE(scene.film().addSplat(Vec2(3), Rgb(kInfinity))); }),
            1u);
  const auto box = filterRegistry().get("box", {}).create({}, {});
  LightImage image({Int2(0), Int2(4)}, box.get());
  image.open(1e-12);
  EXPECT_GE(counted(Rejection::DarkenedSplat, [&] { image.add(Vec2(1.5f), Rgb(1e12f)); }), 3u);
  TinyView view;
  std::string text = tinyScene(view, "LightSource \"infinite\"\n");
  text.insert(text.find("Film \"image\"") + 12, " \"float maxsampleluminance\" 0.5");
  TinyScene darkened(text);
  darkened.render(4);
  EXPECT_EQ(darkened.statistics().value(kRejectionSection, nameOf(Rejection::DarkenedSample)),
            4 * 64);
}

TEST(Rejections, AreReportedWhereThereAreNone) {
  TinyScene scene(tinyScene({}, "LightSource \"infinite\"\n" + matte(0.5f) + square(1)));
  scene.render(1);
  size_t entries = 0;
  for (const auto& e : scene.statistics().entries()) {
    if (e.section != kRejectionSection) continue;
    EXPECT_EQ(e.value, 0) << e.name;
    ++entries;
  }
  EXPECT_EQ(entries, kRejectionCount);
}

}  // namespace
}  // namespace lampyris::test
