// SPDX-License-Identifier: Apache-2.0
/// What every light distribution promises (base/light_distribution.h), for each of the registry.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "light_scenes.h"
#include "lightdistributions/registry.h"
#include "support/statistics.h"

namespace lampyris::test {
namespace {

/// A distribution of the registry, with parameters.
struct Variant {
  std::string label, name;
  TestParameters::List parameters;
  /// The most lights of a cut; one more where there are lights without a position.
  size_t maxCut = 1;
};
void PrintTo(const Variant& v, std::ostream* out) { *out << v.label; }

class LightDistributionContract : public testing::TestWithParam<Variant> {
 protected:
  static const std::vector<std::unique_ptr<LightScene>>& scenes() {
    static const auto all = [] {
      auto scenes = smallLightScenes();
      for (const float scale : {1e-4f, 1e4f})
        for (auto& s : smallLightScenes(scale)) scenes.push_back(std::move(s));
      return scenes;
    }();
    return all;
  }
  static std::string where(const LightScene& scene, size_t context) {
    return scene.name + ", context " + std::to_string(context);
  }
  /// Scenes of another scale repeat one of scale 1.
  static int drawsFor(const LightScene& scene) { return scene.scale == 1 ? 4000 : 1000; }
  std::unique_ptr<LightDistribution> make(const LightScene& scene) {
    return maker_.make(GetParam().name, scene, GetParam().parameters);
  }
  static std::vector<double> pmfs(const LightDistribution& d, const LightSampleContext& c,
                                  size_t n) {
    std::vector<double> all;
    for (LightId l = 0; l < n; ++l) all.push_back(static_cast<double>(d.pmf(c, l)));
    return all;
  }

 private:
  DistributionMaker maker_;
};

TEST_P(LightDistributionContract, SampleReportsPmf) {
  for (const auto& scene : scenes()) {
    const auto distribution = make(*scene);
    const auto contexts = contextsFor(*scene, scene->scale == 1 ? 26 : 13);
    for (size_t k = 0; k < contexts.size(); ++k)
      for (int i = 0; i <= 100; ++i) {
        const float u = std::min(static_cast<float>(i) / 100, kOneMinusEpsilon);
        const auto s = distribution->sample(contexts[k], u);
        if (!s) continue;
        ASSERT_LT(s->light, scene->table.size());
        ASSERT_GT(s->pmf, 0);
        ASSERT_EQ(s->pmf, distribution->pmf(contexts[k], s->light)) << where(*scene, k);
        const auto again = distribution->sample(contexts[k], u);
        ASSERT_TRUE(again && again->light == s->light) << "not a function of its arguments";
      }
  }
}

TEST_P(LightDistributionContract, SumsToOneAndMissesNothing) {
  for (const auto& scene : scenes()) {
    const auto distribution = make(*scene);
    const auto contexts = contextsFor(*scene, scene->scale == 1 ? 26 : 13);
    for (size_t k = 0; k < contexts.size(); ++k) {
      const LightSampleContext& c = contexts[k];
      const auto pmf = pmfs(*distribution, c, scene->table.size());
      const double sum = std::accumulate(pmf.begin(), pmf.end(), 0.);
      for (const double p : pmf) ASSERT_TRUE(p >= 0 && p <= 1 + 1e-6) << where(*scene, k);
      ASSERT_LE(sum, 1 + 1e-4) << where(*scene, k);
      double reached = 0;  // by light that counts
      for (LightId l = 0; l < pmf.size(); ++l)
        for (uint64_t i = 0; i < 8; ++i)
          if (contribution(*scene, c, l, {uniform(5, i, l), uniform(6, i, l)}) > 0) {
            ASSERT_GT(pmf[l], 0) << where(*scene, k) << ", light " << l;
            reached = 1;
          }
      // Point lights alone are reached by every draw.
      if (reached > 0 && scene->name.starts_with("points") && c.reflects && c.transmits) {
        ASSERT_NEAR(sum, 1, 1e-4) << where(*scene, k);
      }
      if (!(c.reflects || c.transmits)) {
        ASSERT_EQ(sum, 0);
      }
      EXPECT_EQ(distribution->pmf(c, kNoLight), 0);
      EXPECT_EQ(distribution->pmf(c, scene->table.size()), 0);
    }
  }
}

TEST_P(LightDistributionContract, DrawsAsPmfSays) {
  for (const auto& scene : scenes()) {
    const auto distribution = make(*scene);
    const auto contexts = contextsFor(*scene, scene->scale == 1 ? 13 : 7);
    const int draws = drawsFor(*scene);
    for (size_t k = 0; k < contexts.size(); ++k) {
      auto expected = pmfs(*distribution, contexts[k], scene->table.size());
      expected.push_back(std::max(0., 1 - std::accumulate(expected.begin(), expected.end(), 0.)));
      if (expected.back() < 1e-4) expected.back() = 0;  // rounding of the sum
      for (double& e : expected) e *= draws;
      std::vector<double> observed(expected.size(), 0.);
      for (int i = 0; i < draws; ++i) {
        const float u = uniform(31 + k, static_cast<uint64_t>(i), 0);
        const auto s = distribution->sample(contexts[k], u);
        ++observed[s ? s->light : scene->table.size()];
      }
      EXPECT_EQ(chiSquareTest(observed, expected), "") << where(*scene, k);
    }
  }
}

TEST_P(LightDistributionContract, CutsDrawAsOftenAsTheySayAndSumUp) {
  for (const auto& scene : scenes()) {
    const auto distribution = make(*scene);
    const auto contexts = contextsFor(*scene, scene->scale == 1 ? 13 : 7);
    const size_t lights = scene->table.size();
    for (size_t k = 0; k < contexts.size(); ++k) {
      const LightSampleContext& c = contexts[k];
      std::vector<double> each(lights);
      std::vector<float> expected(lights);
      double sum = 0;
      for (LightId l = 0; l < lights; ++l) {
        sum += each[l] = contribution(*scene, c, l, {0.5f, 0.4f});
        expected[l] = distribution->expectedCount(c, l);
      }
      const int draws = drawsFor(*scene);
      std::vector<double> values, counts(lights, 0.);
      SampledLights cut;
      for (int i = 0; i < draws; ++i) {
        cut.clear();
        distribution->sampleCut(c, uniform(97 + k, static_cast<uint64_t>(i), 0), cut);
        ASSERT_LE(cut.size(), std::min(GetParam().maxCut + 1, lights));
        double value = 0;
        for (const SampledLight& s : cut) {
          ASSERT_EQ(s.pmf, expected[s.light]);
          value += each[s.light] / static_cast<double>(s.pmf);
          ++counts[s.light];
        }
        values.push_back(value);
      }
      // With so few draws a light of a thousandth of the mass may not come up at all; what that can
      // hide is the largest value that a draw may have, times ten such chances.
      double slack = 0;
      for (LightId l = 0; l < lights; ++l) {
        if (static_cast<double>(distribution->pmf(c, l)) * draws < 40) slack += each[l];
        // A cut holds a light at most a few times: in each draw of it, the count is bounded.
        const double count = draws * static_cast<double>(expected[l]);
        EXPECT_NEAR(counts[l], count, 8 * std::sqrt(count) + 8)
            << where(*scene, k) << ", light " << l;
      }
      // On a light itself the sum is all but infinite.
      if (k % 6 == 5) continue;
      EXPECT_EQ(meanTest(values, sum, 2 * slack + 1e-5 * sum), "") << where(*scene, k);
    }
  }
}

TEST_P(LightDistributionContract, MillionCoincidentLights) {
  const auto scene = coincidentLights(1'000'000);
  const auto distribution = make(*scene);
  for (const LightSampleContext& c : contextsFor(*scene, 4)) {
    if (!(c.reflects && c.transmits)) continue;
    for (int i = 0; i < 50; ++i) {
      const auto s = distribution->sample(c, (static_cast<float>(i) + 0.5f) / 50);
      ASSERT_TRUE(s);
      EXPECT_NEAR(s->pmf, 1e-6f, 1e-8f);  // nodes keep intensities to 8 bits
      EXPECT_EQ(s->pmf, distribution->pmf(c, s->light));
    }
  }
}

TEST_P(LightDistributionContract, SurvivesNonsense) {
  const auto& scene = *scenes()[12];
  ASSERT_EQ(scene.name, "mixed");
  const auto distribution = make(scene);
  for (const float bad : {std::nanf(""), kInfinity, -kInfinity, 3e38f, 1e-40f})
    for (const bool point : {true, false})
      for (const bool transmits : {true, false}) {
        static const Bsdf surface{};
        LightSampleContext c;
        c.bsdf = &surface;
        c.transmits = transmits;
        (point ? c.p : c.ns) = Vec3(bad, 0, bad);
        for (int i = 0; i < 20; ++i) {
          const auto s = distribution->sample(c, static_cast<float>(i) / 20);
          if (s) {
            EXPECT_TRUE(s->pmf > 0 && s->pmf <= 1);
            EXPECT_EQ(s->pmf, distribution->pmf(c, s->light));
          }
        }
        for (LightId l = 0; l < scene.table.size(); ++l) EXPECT_GE(distribution->pmf(c, l), 0);
      }
}

/// All of the registry with defaults, and the forms and splittings of the light BVH.
std::vector<Variant> variants() {
  std::vector<Variant> all;
  for (const auto& e : lightDistributionRegistry().entries()) all.push_back({e.name, e.name, {}});
  for (const char* factors : {"mean", "bound", "thesis"})
    all.push_back(
        {std::string("bvh_binary_") + factors, "bvh", {{"tree", "binary"}, {"factors", factors}}});
  for (const auto& [threshold, maxCut] : {std::pair{"0.1", 2}, {"0.3", 5}, {"0.7", 16}, {"0", 64}})
    all.push_back({std::string("bvh_split_") + threshold + "_" + std::to_string(maxCut),
                   "bvh",
                   {{"splitthreshold", threshold}, {"maxcut", std::to_string(maxCut)}},
                   static_cast<size_t>(maxCut)});
  for (Variant& v : all) std::replace(v.label.begin(), v.label.end(), '.', '_');
  return all;
}
TEST(BvhLightDistribution, RefusesWhatItsTreeCannot) {
  DistributionMaker maker;
  const auto scene = manyLights(10);
  EXPECT_THROW(maker.make("bvh", *scene, {{"tree", "binary"}, {"splitthreshold", "0.5"}}),
               SceneError);
  EXPECT_THROW(maker.make("bvh", *scene, {{"factors", "bound"}}), SceneError);
  EXPECT_THROW(maker.make("bvh", *scene, {{"tree", "ternary"}}), SceneError);
  EXPECT_THROW(maker.make("bvh", *scene, {{"splitthreshold", "1.5"}}), SceneError);
}

TEST(BvhLightDistribution, ShadesAllLightsAtThresholdZero) {
  DistributionMaker maker;
  const auto scene = manyLights(50);
  const auto d = maker.make("bvh", *scene, {{"splitthreshold", "0"}, {"maxcut", "50"}});
  SampledLights cut;
  d->sampleCut(contextsFor(*scene, 1)[0], 0.3f, cut);
  EXPECT_EQ(cut.size(), 50u);
}

INSTANTIATE_TEST_SUITE_P(All, LightDistributionContract, testing::ValuesIn(variants()),
                         [](const auto& variant) { return variant.param.label; });

}  // namespace
}  // namespace lampyris::test
