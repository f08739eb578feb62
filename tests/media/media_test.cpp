// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "base/measured_media.h"
#include "media/henyey_greenstein.h"
#include "media/registry.h"
#include "support/statistics.h"

namespace lampyris::test {

namespace {

class MediumMaker {
 public:
  MediumMaker() : diagnostics_(files_, [this](const std::string& t) { warnings += t; }) {}
  std::unique_ptr<Medium> make(std::vector<Parameter> parameters) {
    return mediumRegistry()
        .get("homogeneous", {})
        .create({parameters, {}}, {{diagnostics_, [](const std::string& n) { return n; }, {}}, {}});
  }
  std::string warnings;

 private:
  SourceFiles files_;
  Diagnostics diagnostics_;
};

Parameter rgb(std::string_view name, std::span<const float> values) {
  Parameter p;
  p.name = name;
  p.type = ParameterType::Rgb;
  p.floats = values;
  return p;
}

TEST(HenyeyGreenstein, IsNormalisedAndSampledExactly) {
  const Vec3 wo = normalize(Vec3(0.3f, -0.5f, 0.7f));
  for (const float g : {-0.9f, -0.3f, 0.f, 0.0005f, 0.4f, 0.85f}) {
    const HenyeyGreenstein phase(g);
    EXPECT_EQ(phase.isIsotropic(), g == 0);
    DirectionTest test;
    test.sample = [&](const Vec2& u, float, Vec3& w) { return w = phase.sample(wo, u), true; };
    test.pdf = [&](const Vec3& w) { return static_cast<double>(phase.p(wo, w)); };
    EXPECT_EQ(directionChiSquareTest(test), "") << g;
    std::vector<double> cosines;
    for (uint64_t i = 0; i < 20'000; ++i)
      cosines.push_back(
          static_cast<double>(dot(-wo, phase.sample(wo, {uniform(7, i, 0), uniform(7, i, 1)}))));
    EXPECT_EQ(meanTest(cosines, static_cast<double>(g)), "") << g;
  }
}

TEST(HenyeyGreenstein, StaysFiniteAtThePeak) {
  for (const float g : {-0.999f, 0.999f}) {
    const HenyeyGreenstein phase(g);
    const Vec3 wo = normalize(Vec3(1, 2, 3));
    const Vec3 peak = g > 0 ? -wo : wo;
    EXPECT_NEAR(phase.p(wo, peak) * 4 * kPi * sqr(1 - std::abs(g)) / (1 + std::abs(g)), 1, 1e-3);
    EXPECT_GT(phase.p(wo, -peak), 0);
  }
}

TEST(Homogeneous, DistancesAndTransmittanceAgree) {
  TrackingCounts counts;
  const float a[] = {0.1f, 0, 0.4f}, s[] = {0.5f, 0.3f, 2};
  MediumMaker maker;
  const auto medium = maker.make({rgb("sigma_a", a), rgb("sigma_s", s)});
  for (const float length : {0.2f, 3.f, 8.f}) {
    Ray ray;
    ray.tMax = length;
    NumberSequence none(0);
    const Rgb t = medium->transmittance(ray, none, counts);
    EXPECT_FLOAT_EQ(t.g, std::exp(-0.3f * length));
    std::vector<double> through, scattered;
    for (uint64_t i = 0; i < 20'000; ++i) {
      NumberSequence numbers(i + 1, {uniform(3, i, 0), uniform(3, i, 1)});
      const MediumSample m = medium->sample(ray, numbers, counts);
      ASSERT_TRUE(m.weight.isFinite());
      EXPECT_TRUE(!m.scatters || m.t < length);
      through.push_back(m.scatters ? 0 : static_cast<double>(m.weight.g));
      scattered.push_back(m.scatters ? static_cast<double>(m.weight.g) : 0);
    }
    // ∫ σs T dt = (σs / σt) (1 − T(length))
    EXPECT_EQ(meanTest(through, static_cast<double>(t.g), 1e-6), "") << length;
    EXPECT_EQ(meanTest(scattered, 1 - static_cast<double>(t.g), 1e-6), "") << length;
  }
}

TEST(Homogeneous, InfiniteRaysAndEmptyChannels) {
  TrackingCounts counts;
  const float a[] = {0, 0, 0}, s[] = {0, 1, 0};
  MediumMaker maker;
  const auto medium = maker.make({rgb("sigma_a", a), rgb("sigma_s", s)});
  Ray ray;  // endless
  double through = 0;
  const int n = 20'000;
  for (int i = 0; i < n; ++i) {
    NumberSequence numbers(static_cast<uint64_t>(i));
    const MediumSample m = medium->sample(ray, numbers, counts);
    ASSERT_TRUE(m.weight.isFinite());
    if (!m.scatters) through += static_cast<double>(m.weight.r) / n;
  }
  EXPECT_NEAR(through, 1, 0.02);  // 8 standard errors
  const auto vacuum = maker.make({rgb("sigma_a", a), rgb("sigma_s", a)});
  NumberSequence numbers(1);
  const MediumSample m = vacuum->sample(ray, numbers, counts);
  EXPECT_FALSE(m.scatters);
  EXPECT_EQ(m.weight, Rgb(1));
}

TEST(Homogeneous, PresetsAndMistakes) {
  TrackingCounts counts;
  MediumMaker maker;
  ASSERT_NE(findMeasuredMedium("Skin1"), nullptr);
  EXPECT_EQ(findMeasuredMedium("Skin1")->sigmaPrimeS, Rgb(0.74f, 0.88f, 1.01f));
  EXPECT_EQ(findMeasuredMedium("Skim milk"), nullptr);
  Parameter preset;
  preset.name = "preset";
  preset.type = ParameterType::String;
  const std::string_view good[] = {"Ketchup"}, bad[] = {"Ketchap"};
  preset.strings = good;
  Ray ray;
  ray.tMax = 1;
  NumberSequence none(0);
  EXPECT_FLOAT_EQ(maker.make({preset})->transmittance(ray, none, counts).r, std::exp(-0.241f));
  EXPECT_EQ(maker.warnings, "");
  preset.strings = bad;
  maker.make({preset});
  EXPECT_NE(maker.warnings.find("did you mean \"Ketchup\""), std::string::npos) << maker.warnings;
  const float negative[] = {-1, 0, 0};
  EXPECT_THROW(maker.make({rgb("sigma_a", negative)}), SceneError);
}

}  // namespace

}  // namespace lampyris::test
