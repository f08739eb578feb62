// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "core/parameters.h"

namespace lampyris {
namespace {

struct Ranges {
  int count = 1;
  float share = 0.5f, width = 1, radius = 1, free = 0;
  bool flag = false;
  Rgb colour{1}, absorption{0};
  RgbInput reflectance{0.5f};
  std::vector<int> steps;
  std::vector<float> densities, window;
  std::string mode = "fast", undeclared;

  void declare(Declaration& d) {
    d.add("count", count, "Count.").range(1, 1 << 30);
    d.add("share", share, "Share.").range(0.01, 1);
    d.add("width", width, "Width.").atLeast(1e-6);
    d.add("radius", radius, "Radius.").clamped(0, 360);
    d.add("free", free, "Free.").any();
    d.add("flag", flag, "Flag.");
    d.add("colour", colour, "Colour.").clamped(0);
    d.add("absorption", absorption, "Absorption.").atLeast(0);
    d.add("reflectance", reflectance, "Reflectance.").clamped(0);
    d.add("steps", steps, "Steps.").clamped(0, 9);
    d.add("densities", densities, "Densities.").atLeast(0).rangeIs("n values, at least 0");
    d.add("window", window, "Window.").clamped(0, 1);
    d.add("mode", mode, "Mode.").oneOf({"fast", "exact"});
    d.add("undeclared", undeclared, "Undeclared.");
  }
};

Ranges with(const std::string& name, const std::string& text) {
  const Schema schema = Schema::of<Ranges>();
  const auto owned = parseOverride(*schema.find(name), text);
  Ranges r;
  schema.read({{&owned->parameter, 1}, {}}, &r);
  return r;
}

std::string errorOf(const std::string& name, const std::string& text) {
  try {
    with(name, text);
  } catch (const SceneError& e) {
    return e.what();
  }
  return "";
}

TEST(ParameterRanges, AreDescribed) {
  const Schema schema = Schema::of<Ranges>();
  const auto text = [&schema](const char* name) { return schema.find(name)->rangeText(); };
  EXPECT_EQ(text("count"), "1 to 1073741824");
  EXPECT_EQ(text("width"), "at least 1e-06");
  EXPECT_EQ(text("radius"), "0 to 360 (clamped)");
  EXPECT_EQ(text("free"), "any");
  EXPECT_EQ(text("flag"), "true or false");
  EXPECT_EQ(text("colour"), "at least 0 (less counts as 0)");
  EXPECT_EQ(text("densities"), "n values, at least 0");
  EXPECT_EQ(text("mode"), "one of fast, exact");
  EXPECT_EQ(text("undeclared"), "");
}

/// However the end is rounded to a float.
TEST(ParameterRanges, HoldTheirEnds) {
  EXPECT_EQ(with("count", "1073741824").count, 1 << 30);
  EXPECT_EQ(with("share", "0.01").share, 0.01f);
  EXPECT_EQ(with("width", "1e-6").width, 1e-6f);
  EXPECT_EQ(errorOf("share", "0.0099"), "parameter \"share\": 0.0099 is outside [0.01, 1]");
  EXPECT_EQ(errorOf("width", "0"), "parameter \"width\": 0 is below 1e-06");
}

TEST(ParameterRanges, ClampedValuesAreNoErrors) {
  EXPECT_EQ(with("radius", "-1").radius, 0.f);
  EXPECT_EQ(with("radius", "361").radius, 360.f);
  EXPECT_EQ(with("radius", "90").radius, 90.f);
  EXPECT_EQ(with("colour", "-1 0.5 2").colour, Rgb(0, 0.5f, 2));
  EXPECT_EQ(with("reflectance", "3 -1e-3 0").reflectance.value, Rgb(3, 0, 0));
  EXPECT_EQ(with("steps", "-3 4 12").steps, (std::vector<int>{0, 4, 9}));
  EXPECT_EQ(with("window", "-0.5 0.25 2").window, (std::vector<float>{0, 0.25f, 1}));
}

TEST(ParameterRanges, HoldForComponentsAndElements) {
  EXPECT_EQ(errorOf("absorption", "1 1 -0.5"), "parameter \"absorption\": -0.5 is below 0");
  EXPECT_EQ(errorOf("densities", "0 1 -2"), "parameter \"densities\": -2 is below 0");
  EXPECT_EQ(errorOf("free", "-1e30"), "");
}

}  // namespace
}  // namespace lampyris
