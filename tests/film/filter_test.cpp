// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <map>

#include "core/math.h"
#include "film/filter_registry.h"
#include "support/statistics.h"

namespace lampyris {
namespace {

using Values = std::map<std::string, float>;

std::unique_ptr<Filter> make(const std::string& name, const Values& values = {}) {
  std::vector<Parameter> parameters;
  for (const auto& [key, value] : values) {
    Parameter p;
    p.name = key;
    p.floats = {&value, 1};
    parameters.push_back(p);
  }
  return filterRegistry().get(name, {}).create({parameters, {}}, {});
}

class EveryFilter : public testing::TestWithParam<std::string> {};

INSTANTIATE_TEST_SUITE_P(Filters, EveryFilter, testing::ValuesIn(filterRegistry().names()),
                         [](const auto& param) { return param.param; });

/// ∫ f g / ∫ f on a fine grid.
double filtered(const Filter& f, const std::function<double(Vec2)>& g) {
  const Vec2 r = f.radius();
  constexpr int kSteps = 400;
  double sum = 0, weight = 0;
  for (int y = 0; y < kSteps; ++y)
    for (int x = 0; x < kSteps; ++x) {
      const Vec2 p =
          (Vec2(static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f) * (2.f / kSteps) -
           1.f) *
          r;
      const auto v = static_cast<double>(f.evaluate(p));
      sum += v * g(p);
      weight += v;
    }
  return sum / weight;
}

void expectUnbiased(const Filter& f) {
  const Vec2 r = f.radius();
  const std::function<double(Vec2)> functions[] = {
      [](Vec2) { return 1.; },
      [](Vec2 p) { return static_cast<double>(p.x); },
      [r](Vec2 p) { return static_cast<double>(sqr(p.x / r.x) + 2 * sqr(p.y / r.y)); },
      [r](Vec2 p) { return std::cos(3. * static_cast<double>(p.x / r.x + p.y / r.y)); },
  };
  for (size_t k = 0; k < std::size(functions); ++k) {
    std::vector<double> values;
    for (uint64_t i = 0; i < 200'000; ++i) {
      const FilterSample s = f.sample({test::uniform(k, i, 0), test::uniform(k, i, 1)});
      ASSERT_LE(std::abs(s.offset.x), r.x);
      ASSERT_LE(std::abs(s.offset.y), r.y);
      ASSERT_TRUE(std::isfinite(s.weight));
      values.push_back(static_cast<double>(s.weight) * functions[k](s.offset));
    }
    EXPECT_EQ(test::meanTest(values, filtered(f, functions[k]), 2e-4), "") << k;
  }
}

TEST_P(EveryFilter, SamplesAreUnbiased) { expectUnbiased(*make(GetParam())); }

TEST_P(EveryFilter, SamplesAreUnbiasedWhateverTheWidth) {
  expectUnbiased(*make(GetParam(), {{"xwidth", 1.25f}, {"ywidth", 0.75f}}));
  expectUnbiased(*make(GetParam(), {{"xwidth", 6.f}, {"ywidth", 0.1f}}));
}

TEST_P(EveryFilter, WeightsOfPositiveFiltersHardlyVary) {
  const auto f = make(GetParam());
  bool negative = false;
  for (uint64_t i = 0; i < 20'000; ++i) {
    const FilterSample s = f->sample({test::uniform(1, i, 0), test::uniform(1, i, 1)});
    EXPECT_LT(std::abs(s.weight), 4);
    negative = negative || s.weight < 0;
    if (GetParam() == "box" || GetParam() == "triangle") {
      EXPECT_EQ(s.weight, 1.f);
    }
  }
  EXPECT_EQ(negative, GetParam() == "mitchell" || GetParam() == "sinc");
}

TEST_P(EveryFilter, IsEvenAndEndsAtItsRadius) {
  const auto f = make(GetParam());
  const Vec2 r = f->radius();
  for (const float t : {0.f, 0.1f, 0.3f, 0.55f, 0.9f, 0.99f}) {
    const Vec2 p(t * r.x, 0.2f * r.y);
    EXPECT_FLOAT_EQ(f->evaluate(p), f->evaluate(-p));
    EXPECT_FLOAT_EQ(f->evaluate(p), f->evaluate({-p.x, p.y}));
  }
  EXPECT_EQ(f->evaluate({1.01f * r.x, 0}), 0.f);
  EXPECT_EQ(f->evaluate({0, -1.01f * r.y}), 0.f);
  EXPECT_GT(f->evaluate({0, 0}), 0.f);
}

TEST_P(EveryFilter, ExtremeNumbersAreFine) {
  for (const float u : {0.f, 1e-8f, 0.5f, kOneMinusEpsilon})
    for (const float v : {0.f, kOneMinusEpsilon}) {
      const FilterSample s = make(GetParam())->sample({u, v});
      EXPECT_TRUE(std::isfinite(s.weight) && std::isfinite(s.offset.x) &&
                  std::isfinite(s.offset.y));
    }
}

TEST_P(EveryFilter, RejectsWidthsThatAreNone) {
  EXPECT_THROW(make(GetParam(), {{"xwidth", 0.f}}), SceneError);
  EXPECT_THROW(make(GetParam(), {{"ywidth", -1.f}}), SceneError);
  EXPECT_THROW(make(GetParam(), {{"xwidth", 1e9f}}), SceneError);
}

TEST(Filters, DefaultsOfPbrt) {
  EXPECT_EQ(make("box")->radius(), Vec2(0.5f));
  EXPECT_EQ(make("triangle")->radius(), Vec2(2));
  EXPECT_EQ(make("gaussian")->radius(), Vec2(2));
  EXPECT_EQ(make("mitchell")->radius(), Vec2(2));
  EXPECT_EQ(make("sinc")->radius(), Vec2(4));
}

TEST(Filters, KnownValues) {
  EXPECT_EQ(make("box")->evaluate({0.3f, -0.4f}), 1.f);
  EXPECT_FLOAT_EQ(make("triangle")->evaluate({0.5f, -1}), 1.5f * 1);
  const double edge = std::exp(-8.);
  EXPECT_NEAR(make("gaussian")->evaluate({0.5f, 0}), (std::exp(-0.5) - edge) * (1 - edge), 1e-6);
  // The cubic's value at 0 is (6 − 2B) / 6, at t = 1 it is B / 6.
  EXPECT_NEAR(make("mitchell")->evaluate({0, 0}), 64 / 81., 1e-6);
  EXPECT_NEAR(make("mitchell")->evaluate({1, 0}), 1 / 18. * 8 / 9, 1e-6);
  EXPECT_NEAR(make("mitchell", {{"B", 0.f}, {"C", 0.5f}})->evaluate({1.5f, 0}), -0.0625, 1e-6);
  EXPECT_NEAR(make("sinc")->evaluate({0, 0}), 1, 1e-6);
  EXPECT_NEAR(make("sinc")->evaluate({1, 0}), 0, 1e-6);
  EXPECT_NEAR(make("sinc")->evaluate({1.5f, 0}), -2 / (3 * M_PI) * (2 / M_PI), 1e-6);
}

TEST(Filters, OddParametersStayUnbiased) {
  expectUnbiased(*make("gaussian", {{"alpha", 1e-5f}}));
  expectUnbiased(*make("gaussian", {{"alpha", 30.f}}));
  expectUnbiased(*make("mitchell", {{"B", 1.f}, {"C", 0.f}}));
  expectUnbiased(*make("sinc", {{"tau", 0.7f}, {"xwidth", 2.f}, {"ywidth", 2.f}}));
  EXPECT_THROW(make("gaussian", {{"alpha", 0.f}}), SceneError);
  EXPECT_THROW(make("sinc", {{"tau", 0.f}}), SceneError);
}

TEST(Filters, ANarrowBellInAWideWindow) {
  const auto f = make("gaussian", {{"alpha", 1e5f}, {"xwidth", 50.f}, {"ywidth", 50.f}});
  std::vector<double> weights, squares;
  for (uint64_t i = 0; i < 50'000; ++i) {
    const FilterSample s = f->sample({test::uniform(4, i, 0), test::uniform(4, i, 1)});
    weights.push_back(static_cast<double>(s.weight));
    squares.push_back(static_cast<double>(s.weight) * 2e5 * static_cast<double>(sqr(s.offset.x)));
  }
  EXPECT_EQ(test::meanTest(weights, 1, 1e-4), "");
  EXPECT_EQ(test::meanTest(squares, 1, 1e-4), "");
}

}  // namespace
}  // namespace lampyris
