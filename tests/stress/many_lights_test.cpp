// SPDX-License-Identifier: Apache-2.0
/// A million lights, at one point or beside one that outshines them all, for every distribution.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "integrators/registry.h"
#include "lightdistributions/registry.h"
#include "stress/stress.h"
#include "support/resolvers.h"
#include "support/statistics.h"

namespace lampyris::test {
namespace {

constexpr size_t kMany = 1'000'000;

/// A floor, seen from above its middle, and lamps.
std::string floorWith(const std::string& lamps) {
  TinyView view;
  view.lookAt = "0 0 0.5  0 0 0  0 1 0";
  return tinyScene(view, lamps + matte(0.5f) + square(1));
}

/// Renders the scene, which is read once, with "path" and a light distribution.
class Renderer {
 public:
  explicit Renderer(const std::string& text) : scene_(text), empty_(scene_.film().save()) {}

  Scene& scene() { return scene_.job().scene; }
  std::unique_ptr<LightDistribution> make(const LightDistributionRegistry::Entry& e) {
    return e.create({}, LightDistributionContext{build_.base(), scene().lightTable, scene().bounds,
                                                 scene_.statistics()});
  }
  /// Replaces the image and the light distribution.
  TinyScene& render(std::unique_ptr<LightDistribution> d, uint64_t samples) {
    const auto light = [&](const std::string&, const IntegratorContext::Settings&) {
      return std::move(d);
    };
    scene_.job().integrator = integratorRegistry()
                                  .get("path", {})
                                  .create({}, IntegratorContext{build_.base(), scene(), light, 0});
    scene_.film().restore(empty_);
    scene_.render(samples);
    return scene_;
  }

 private:
  TestBuild build_;
  TinyScene scene_;
  std::string empty_;
};

LightSampleContext middleOfTheFloor() {
  static const Bsdf matte{};  // distributions need its flags alone
  LightSampleContext at;
  at.bsdf = &matte;
  at.transmits = false;
  return at;
}

/// The contract for some of a million lights. Returns the share of draws that `counts`.
double expectContract(const LightDistribution& d, LightId lights, auto&& counts) {
  const LightSampleContext at = middleOfTheFloor();
  constexpr int kDraws = 4000;
  int counted = 0;
  for (int i = 0; i < kDraws; ++i) {
    const auto s = d.sample(at, (static_cast<float>(i) + 0.5f) / kDraws);
    if (!s) continue;
    EXPECT_TRUE(s->pmf > 0 && s->pmf <= 1) << s->pmf;
    EXPECT_EQ(s->pmf, d.pmf(at, s->light));
    counted += counts(s->light);
  }
  for (LightId id = 0; id < lights; id += 1009) EXPECT_TRUE(d.pmf(at, id) > 0 || !counts(id)) << id;
  return static_cast<double>(counted) / kDraws;
}

TEST(ManyLights, AMillionAtOnePoint) {
  std::string lamps = "AttributeBegin\nTranslate 0 0.75 1\n";
  for (size_t i = 0; i < kMany; ++i) lamps += "LightSource \"point\"\n";
  Renderer renderer(floorWith(lamps + "AttributeEnd\n"));
  const double expected = 0.5 / M_PI * kMany / std::pow(0.75 * 0.75 + 1, 1.5);
  for (const auto& e : lightDistributionRegistry().entries()) {
    SCOPED_TRACE(e.name);
    auto distribution = renderer.make(e);
    expectContract(*distribution, kMany, [](LightId) { return true; });
    TinyScene& scene = renderer.render(std::move(distribution), 16);
    expectSound(scene);
    EXPECT_EQ(meanTest(scene.greens(), expected, 1e-5 * expected), "");
  }
}

TEST(ManyLights, OneOutshinesAMillion) {
  DScene weak;
  std::string lamps;
  for (size_t i = 0; i < kMany; ++i) {
    const auto at = [&](uint32_t axis) { return std::round(1e3 * uniform(5, i, axis)) / 1e3; };
    const DVec3 p(Vec3(2 * at(0) - 1, 2 * at(1) - 1, 0.75 + at(2)));
    weak.lamps.push_back({p, 1});
    lamps +=
        fmt::format("LightSource \"point\" \"point from\" [{:.4g} {:.4g} {:.4g}]\n", p.x, p.y, p.z);
  }
  const double ofWeak = weak.irradiance(DVec3(0), 1);
  for (const bool visible : {true, false}) {
    SCOPED_TRACE(visible ? "visible" : "behind the floor");
    const std::string strong =
        fmt::format("LightSource \"point\" \"rgb I\" [1e12 1e12 1e12] \"point from\" [0 0 {}]\n",
                    visible ? 2 : -2);
    Renderer renderer(floorWith(lamps + strong));
    const double expected = 0.5 / M_PI * ((visible ? 1e12 / 4 : 0) + ofWeak);
    for (const auto& e : lightDistributionRegistry().entries()) {
      SCOPED_TRACE(e.name);
      auto distribution = renderer.make(e);
      const double share = expectContract(*distribution, kMany, [&](LightId id) {
        return (id == kMany) == visible;  // the light that matters, or one of those that do
      });
      TinyScene& scene = renderer.render(std::move(distribution), 64);
      expectSound(scene);
      // A distribution that nearly never draws what matters has noise instead of a mean.
      if (share < 0.01) continue;
      EXPECT_EQ(meanTest(scene.greens(), expected, 1e-5 * expected), "");
    }
  }
}

}  // namespace
}  // namespace lampyris::test
