// SPDX-License-Identifier: Apache-2.0
#include "core/parameters.h"

#include <gtest/gtest.h>

#include <deque>
#include <limits>

namespace lampyris {
namespace {

using P = ParameterType;

/// Parameters as a scene file would hold them.
class Set {
 public:
  Set& floats(P type, std::string_view name, std::vector<float> values) {
    const auto& kept = floats_.emplace_back(std::move(values));
    push(name, type).floats = kept;
    return *this;
  }
  Set& integers(std::string_view name, std::vector<int32_t> values) {
    const auto& kept = integers_.emplace_back(std::move(values));
    push(name, P::Integer).integers = kept;
    return *this;
  }
  Set& strings(P type, std::string_view name, std::vector<std::string_view> values) {
    const auto& kept = strings_.emplace_back(std::move(values));
    push(name, type).strings = kept;
    return *this;
  }
  ParameterSet get() const { return {parameters_, {}}; }

 private:
  Parameter& push(std::string_view name, P type) {
    Parameter p;
    p.name = name;
    p.type = type;
    p.location = {1, 7 * (static_cast<uint32_t>(parameters_.size()) + 1)};
    return parameters_.emplace_back(p);
  }
  std::deque<std::vector<float>> floats_;
  std::deque<std::vector<int32_t>> integers_;
  std::deque<std::vector<std::string_view>> strings_;
  std::vector<Parameter> parameters_;
};

struct Everything {
  int count = 3;
  float size = 0.5f;
  bool flag = true;
  std::string mode = "fast";
  Vec2 corner{1, 2};
  Vec3 from{1, 2, 3};
  Vec3 axis{0, 0, 1};
  Rgb colour{0.25f};
  FloatInput roughness{0.1f};
  RgbInput kd{0.5f};
  std::vector<int> indices;
  std::vector<float> knots;
  std::vector<std::string> names;
  std::vector<Vec2> uv;
  std::vector<Vec3> points, normals;
  std::optional<int> maybeInt;
  std::optional<float> maybeFloat;
  std::optional<bool> maybeBool;
  std::optional<std::string> maybeString;
  std::optional<Rgb> maybeRgb;
  std::optional<FloatInput> maybeFloatInput;
  std::optional<RgbInput> maybeRgbInput;

  void declare(Declaration& d) {
    d.add("count", count, "Count.").range(1, 10).alias("n");
    d.add("size", size, "Size.").atLeast(0);
    d.add("flag", flag, "Flag.");
    d.add("mode", mode, "Mode.").oneOf({"fast", "exact", "both"});
    d.add("corner", corner, "Corner.");
    d.add("from", from, "From.");
    d.add("axis", axis, "Axis.").type(P::Vector3);
    d.add("colour", colour, "Colour.");
    d.add("roughness", roughness, "Roughness.").range(0, 1);
    d.add("kd", kd, "Kd.").defaultIs("grey");
    d.add("indices", indices, "Indices.").atLeast(0);
    d.add("knots", knots, "Knots.").range(-1, 1);
    d.add("names", names, "Names.");
    d.add("uv", uv, "Uv.");
    d.add("P", points, "Points.");
    d.add("N", normals, "Normals.").type(P::Normal);
    d.add("maybeint", maybeInt, "Optional.").range(0, 5);
    d.add("maybefloat", maybeFloat, "Optional.");
    d.add("maybebool", maybeBool, "Optional.");
    d.add("maybestring", maybeString, "Optional.");
    d.add("mayberg", maybeRgb, "Optional.");
    d.add("maybefloatinput", maybeFloatInput, "Optional.");
    d.add("mayberginput", maybeRgbInput, "Optional.");
    d.ignored("old", "nobody needs it");
  }
};

Everything read(const Set& set) {
  Everything e;
  Schema::of<Everything>().read(set.get(), &e);
  return e;
}

std::string errorOf(const Set& set) {
  try {
    read(set);
  } catch (const SceneError& e) {
    EXPECT_EQ(e.location.file, 1u);
    EXPECT_EQ(e.location.offset, 7u);
    return e.what();
  }
  return "";
}

TEST(Schema, DefaultsStay) {
  const Everything e = read({});
  EXPECT_EQ(e.count, 3);
  EXPECT_EQ(e.mode, "fast");
  EXPECT_EQ(e.kd.value, Rgb(0.5f));
  EXPECT_FALSE(e.maybeInt || e.maybeFloat || e.maybeBool || e.maybeString || e.maybeRgb ||
               e.maybeFloatInput || e.maybeRgbInput);
}

TEST(Schema, ReadsEveryTarget) {
  Set set;
  set.integers("count", {7})
      .floats(P::Float, "size", {2.5f})
      .strings(P::Bool, "flag", {"false"})
      .strings(P::String, "mode", {"exact"})
      .floats(P::Point2, "corner", {4, 5})
      .floats(P::Point3, "from", {6, 7, 8})
      .floats(P::Vector3, "axis", {1, 0, 0})
      .floats(P::Rgb, "colour", {0.1f, 0.2f, 0.3f})
      .floats(P::Float, "roughness", {0.75f})
      .floats(P::Rgb, "kd", {1, 2, 3})
      .integers("indices", {0, 1, 2})
      .floats(P::Float, "knots", {-1, 0, 1})
      .strings(P::String, "names", {"a", "b"})
      .floats(P::Float, "uv", {0, 1, 2, 3})
      .floats(P::Point3, "P", {1, 2, 3, 4, 5, 6})
      .floats(P::Normal, "N", {0, 0, 1})
      .integers("maybeint", {5})
      .floats(P::Float, "maybefloat", {-1})
      .strings(P::Bool, "maybebool", {"true"})
      .strings(P::String, "maybestring", {"text"})
      .floats(P::Rgb, "mayberg", {1, 1, 1})
      .strings(P::Texture, "maybefloatinput", {"bumps"})
      .floats(P::Rgb, "mayberginput", {3, 2, 1});
  const Everything e = read(set);
  EXPECT_EQ(e.count, 7);
  EXPECT_EQ(e.size, 2.5f);
  EXPECT_FALSE(e.flag);
  EXPECT_EQ(e.mode, "exact");
  EXPECT_EQ(e.corner, Vec2(4, 5));
  EXPECT_EQ(e.from, Vec3(6, 7, 8));
  EXPECT_EQ(e.axis, Vec3(1, 0, 0));
  EXPECT_EQ(e.colour, Rgb(0.1f, 0.2f, 0.3f));
  EXPECT_EQ(e.roughness.value, 0.75f);
  EXPECT_TRUE(e.roughness.texture.empty());
  EXPECT_TRUE(e.roughness.location.known());
  EXPECT_EQ(e.kd.value, Rgb(1, 2, 3));
  EXPECT_EQ(e.indices, (std::vector<int>{0, 1, 2}));
  EXPECT_EQ(e.knots, (std::vector<float>{-1, 0, 1}));
  EXPECT_EQ(e.names, (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(e.uv, (std::vector<Vec2>{{0, 1}, {2, 3}}));
  EXPECT_EQ(e.points, (std::vector<Vec3>{{1, 2, 3}, {4, 5, 6}}));
  EXPECT_EQ(e.normals, (std::vector<Vec3>{{0, 0, 1}}));
  EXPECT_EQ(e.maybeInt, 5);
  EXPECT_EQ(e.maybeFloat, -1.f);
  EXPECT_EQ(e.maybeBool, true);
  EXPECT_EQ(e.maybeString, "text");
  EXPECT_EQ(e.maybeRgb, Rgb(1));
  ASSERT_TRUE(e.maybeFloatInput && e.maybeRgbInput);
  EXPECT_EQ(e.maybeFloatInput->texture, "bumps");
  EXPECT_EQ(e.maybeRgbInput->value, Rgb(3, 2, 1));
}

TEST(Schema, ReadsColoursOfEveryKind) {
  EXPECT_EQ(read(Set().floats(P::Xyz, "colour", {0, 0, 0})).colour, Rgb());
  EXPECT_NEAR(read(Set().floats(P::Xyz, "colour", {0.9505f, 1, 1.089f})).colour.g, 1, 1e-3);
  const Rgb half = read(Set().floats(P::Blackbody, "colour", {6500, 0.5f})).colour;
  const Rgb whole = read(Set().floats(P::Blackbody, "colour", {6500, 1})).colour;
  EXPECT_FLOAT_EQ(whole.r, 2 * half.r);
  EXPECT_NEAR(read(Set().floats(P::Spectrum, "colour", {400, 1, 700, 1})).colour.g, 1, 0.06);
  EXPECT_EQ(read(Set().strings(P::Texture, "kd", {"wood"})).kd.texture, "wood");
}

TEST(Schema, IntegersAreGoodFloats) {
  EXPECT_EQ(read(Set().integers("size", {4})).size, 4.f);
  EXPECT_EQ(read(Set().integers("roughness", {1})).roughness.value, 1.f);
  EXPECT_EQ(read(Set().integers("knots", {1, 0})).knots, (std::vector<float>{1, 0}));
}

TEST(Schema, LastOfANameCountsAndAliasesAreNames) {
  EXPECT_EQ(read(Set().integers("count", {7}).integers("count", {8})).count, 8);
  EXPECT_EQ(read(Set().integers("n", {9})).count, 9);
  Set twice;
  twice.integers("count", {7}).integers("count", {8});
  EXPECT_EQ(twice.get().find("count")->integers[0], 8);
  EXPECT_EQ(twice.get().find("size"), nullptr);
}

TEST(Schema, IgnoredAndUnknownParametersAreNotRead) {
  const Everything e = read(Set().integers("old", {7}).strings(P::Bool, "nonsense", {"?"}));
  EXPECT_EQ(e.count, 3);
}

TEST(Schema, WrongTypes) {
  EXPECT_EQ(errorOf(Set().floats(P::Float, "count", {1})),
            "parameter \"count\": expected integer, got float");
  EXPECT_EQ(errorOf(Set().strings(P::String, "size", {"1"})),
            "parameter \"size\": expected float, got string");
  EXPECT_EQ(errorOf(Set().integers("flag", {1})), "parameter \"flag\": expected bool, got integer");
  EXPECT_EQ(errorOf(Set().strings(P::Bool, "mode", {"true"})),
            "parameter \"mode\": expected string, got bool");
  EXPECT_EQ(errorOf(Set().floats(P::Point3, "corner", {1, 2, 3})),
            "parameter \"corner\": expected point2, got point");
  EXPECT_EQ(errorOf(Set().floats(P::Point2, "from", {1, 2})),
            "parameter \"from\": expected point, got point2");
  EXPECT_EQ(errorOf(Set().floats(P::Point3, "axis", {1, 2, 3})),
            "parameter \"axis\": expected vector, got point");
  EXPECT_EQ(errorOf(Set().floats(P::Float, "colour", {1})),
            "parameter \"colour\": expected rgb (or xyz, spectrum, blackbody), got float");
  EXPECT_EQ(errorOf(Set().strings(P::Texture, "colour", {"a"})),
            "parameter \"colour\": expected rgb (or xyz, spectrum, blackbody), got texture");
  EXPECT_EQ(errorOf(Set().floats(P::Rgb, "roughness", {1, 1, 1})),
            "parameter \"roughness\": expected float or texture, got rgb");
  EXPECT_EQ(errorOf(Set().floats(P::Float, "kd", {1})),
            "parameter \"kd\": expected rgb (or xyz, spectrum, blackbody) or texture, got float");
  EXPECT_EQ(errorOf(Set().floats(P::Float, "indices", {1})),
            "parameter \"indices\": expected integer, got float");
  EXPECT_EQ(errorOf(Set().strings(P::String, "knots", {"x"})),
            "parameter \"knots\": expected float, got string");
  EXPECT_EQ(errorOf(Set().integers("names", {1})),
            "parameter \"names\": expected string, got integer");
  EXPECT_EQ(errorOf(Set().integers("uv", {1, 2})),
            "parameter \"uv\": expected point2, got integer");
  EXPECT_EQ(errorOf(Set().floats(P::Float, "P", {1, 2, 3})),
            "parameter \"P\": expected point, got float");
  EXPECT_EQ(errorOf(Set().floats(P::Point3, "N", {0, 0, 1})),
            "parameter \"N\": expected normal, got point");
  EXPECT_EQ(errorOf(Set().strings(P::String, "maybeint", {"1"})),
            "parameter \"maybeint\": expected integer, got string");
}

TEST(Schema, WrongCounts) {
  EXPECT_EQ(errorOf(Set().integers("count", {1, 2})),
            "parameter \"count\": expected 1 value, got 2");
  EXPECT_EQ(errorOf(Set().integers("count", {})), "parameter \"count\": expected 1 value, got 0");
  EXPECT_EQ(errorOf(Set().floats(P::Float, "size", {})),
            "parameter \"size\": expected 1 value, got 0");
  EXPECT_EQ(errorOf(Set().strings(P::Bool, "flag", {})),
            "parameter \"flag\": expected 1 value, got 0");
  EXPECT_EQ(errorOf(Set().strings(P::String, "mode", {"fast", "exact"})),
            "parameter \"mode\": expected 1 value, got 2");
  EXPECT_EQ(errorOf(Set().floats(P::Point2, "corner", {1})),
            "parameter \"corner\": expected 2 values, got 1");
  EXPECT_EQ(errorOf(Set().floats(P::Point3, "from", {1, 2, 3, 4})),
            "parameter \"from\": expected 3 values, got 4");
  EXPECT_EQ(errorOf(Set().floats(P::Rgb, "colour", {1})),
            "parameter \"colour\": expected 3 values, got 1");
  EXPECT_EQ(errorOf(Set().floats(P::Xyz, "colour", {1, 2})),
            "parameter \"colour\": expected 3 values, got 2");
  EXPECT_EQ(errorOf(Set().floats(P::Blackbody, "colour", {6500})),
            "parameter \"colour\": expected temperature and scale, got 1 values");
  EXPECT_EQ(errorOf(Set().floats(P::Spectrum, "colour", {400, 1, 500})),
            "parameter \"colour\": expected wavelength, value pairs, got 3 values");
  EXPECT_EQ(errorOf(Set().floats(P::Spectrum, "colour", {})),
            "parameter \"colour\": expected wavelength, value pairs, got 0 values");
  EXPECT_EQ(errorOf(Set().strings(P::Texture, "kd", {})),
            "parameter \"kd\": expected 1 value, got 0");
  EXPECT_EQ(errorOf(Set().strings(P::Texture, "roughness", {"a", "b"})),
            "parameter \"roughness\": expected 1 value, got 2");
  EXPECT_EQ(errorOf(Set().floats(P::Point2, "uv", {1, 2, 3})),
            "parameter \"uv\": expected pairs, got 3 values");
  EXPECT_EQ(errorOf(Set().floats(P::Point3, "P", {1, 2, 3, 4})),
            "parameter \"P\": expected triples, got 4 values");
}

TEST(Schema, RangesAndChoices) {
  EXPECT_EQ(errorOf(Set().integers("count", {0})), "parameter \"count\": 0 is outside [1, 10]");
  EXPECT_EQ(errorOf(Set().integers("count", {11})), "parameter \"count\": 11 is outside [1, 10]");
  EXPECT_EQ(read(Set().integers("count", {10})).count, 10);
  EXPECT_EQ(errorOf(Set().floats(P::Float, "size", {-0.5f})),
            "parameter \"size\": -0.5 is below 0");
  EXPECT_EQ(errorOf(Set().floats(P::Float, "roughness", {2})),
            "parameter \"roughness\": 2 is outside [0, 1]");
  EXPECT_EQ(errorOf(Set().integers("indices", {0, -1})), "parameter \"indices\": -1 is below 0");
  EXPECT_EQ(errorOf(Set().floats(P::Float, "knots", {0, 3})),
            "parameter \"knots\": 3 is outside [-1, 1]");
  EXPECT_EQ(errorOf(Set().integers("maybeint", {6})),
            "parameter \"maybeint\": 6 is outside [0, 5]");
  EXPECT_EQ(errorOf(Set().strings(P::String, "mode", {"exakt"})),
            "parameter \"mode\": unknown value \"exakt\", expected one of fast, exact, both; did "
            "you mean \"exact\"?");
  EXPECT_EQ(errorOf(Set().strings(P::String, "mode", {"zzzzzz"})),
            "parameter \"mode\": unknown value \"zzzzzz\", expected one of fast, exact, both");
}

TEST(Schema, NumbersAreFiniteAndBoolsAreBools) {
  const float inf = std::numeric_limits<float>::infinity();
  EXPECT_EQ(errorOf(Set().floats(P::Float, "size", {inf})),
            "parameter \"size\": inf is not a finite number");
  EXPECT_EQ(errorOf(Set().floats(P::Float, "maybefloat", {std::nanf("")})),
            "parameter \"maybefloat\": nan is not a finite number");
  EXPECT_EQ(errorOf(Set().floats(P::Point3, "P", {1, 2, -inf})),
            "parameter \"P\": -inf is not a finite number");
  EXPECT_EQ(errorOf(Set().floats(P::Rgb, "kd", {1, inf, 1})),
            "parameter \"kd\": inf is not a finite number");
  EXPECT_EQ(errorOf(Set().strings(P::Bool, "flag", {"yes"})),
            "parameter \"flag\": expected true or false, got \"yes\"");
}

TEST(Schema, DescribesItself) {
  const Schema s = Schema::of<Everything>();
  ASSERT_TRUE(s.find("n"));
  EXPECT_EQ(s.find("n")->name, "count");
  EXPECT_EQ(s.find("count")->defaultText, "3");
  EXPECT_EQ(s.find("size")->defaultText, "0.5");
  EXPECT_EQ(s.find("flag")->defaultText, "true");
  EXPECT_EQ(s.find("mode")->defaultText, "\"fast\"");
  EXPECT_EQ(s.find("from")->defaultText, "[1 2 3]");
  EXPECT_EQ(s.find("kd")->defaultText, "grey");
  EXPECT_EQ(s.find("maybeint")->defaultText, "not set");
  EXPECT_EQ(s.find("N")->typeText(), "normal");
  EXPECT_EQ(s.find("missing"), nullptr);
  const auto names = s.names();
  EXPECT_EQ(names.size(), s.declarations().size() + 1);
}

TEST(ParameterTypes, NamesAndAliases) {
  for (int i = 0; i <= static_cast<int>(P::Texture); ++i) {
    const auto t = static_cast<P>(i);
    EXPECT_EQ(typeFromName(typeName(t)), t);
  }
  EXPECT_EQ(typeFromName("color"), P::Rgb);
  EXPECT_EQ(typeFromName("point3"), P::Point3);
  EXPECT_EQ(typeFromName("vector3"), P::Vector3);
  EXPECT_EQ(typeFromName("normal3"), P::Normal);
  EXPECT_FALSE(typeFromName("double"));
  EXPECT_FALSE(typeFromName(""));
}

Everything overridden(const std::string& name, const std::string& text) {
  const Schema schema = Schema::of<Everything>();
  const auto owned = parseOverride(*schema.find(name), text);
  Everything e;
  schema.read({{&owned->parameter, 1}, {}}, &e);
  return e;
}

TEST(Override, EveryTarget) {
  EXPECT_EQ(overridden("count", "4").count, 4);
  EXPECT_EQ(overridden("n", "4").count, 4);
  EXPECT_EQ(overridden("size", " 0.125 ").size, 0.125f);
  EXPECT_FALSE(overridden("flag", "false").flag);
  EXPECT_EQ(overridden("mode", "both").mode, "both");
  EXPECT_EQ(overridden("corner", "3 4").corner, Vec2(3, 4));
  EXPECT_EQ(overridden("from", "3,4,5").from, Vec3(3, 4, 5));
  EXPECT_EQ(overridden("axis", "3 4 5").axis, Vec3(3, 4, 5));
  EXPECT_EQ(overridden("colour", "0.5 0.5 1").colour, Rgb(0.5f, 0.5f, 1));
  EXPECT_EQ(overridden("roughness", "1").roughness.value, 1.f);
  EXPECT_EQ(overridden("kd", "1 2 3").kd.value, Rgb(1, 2, 3));
  EXPECT_EQ(overridden("indices", "1 2 3 4").indices.size(), 4u);
  EXPECT_EQ(overridden("knots", "-1 1e-1").knots, (std::vector<float>{-1, 0.1f}));
  EXPECT_EQ(overridden("names", "one").names, (std::vector<std::string>{"one"}));
  EXPECT_EQ(overridden("uv", "1 2").uv, (std::vector<Vec2>{{1, 2}}));
  EXPECT_EQ(overridden("N", "0 1 0").normals, (std::vector<Vec3>{{0, 1, 0}}));
  EXPECT_EQ(overridden("maybeint", "2").maybeInt, 2);
  EXPECT_EQ(overridden("maybestring", "").maybeString, "");
}

TEST(Override, Errors) {
  EXPECT_THROW(overridden("count", "x"), SceneError);
  EXPECT_THROW(overridden("count", "1.5"), SceneError);
  EXPECT_THROW(overridden("count", ""), SceneError);
  EXPECT_THROW(overridden("count", "1 2"), SceneError);
  EXPECT_THROW(overridden("count", "99999999999"), SceneError);
  EXPECT_THROW(overridden("count", "11"), SceneError);
  EXPECT_THROW(overridden("size", "inf"), SceneError);
  EXPECT_THROW(overridden("size", "nan"), SceneError);
  EXPECT_THROW(overridden("size", "1e99"), SceneError);
  EXPECT_THROW(overridden("flag", "yes"), SceneError);
  EXPECT_THROW(overridden("mode", "slow"), SceneError);
  EXPECT_THROW(overridden("from", "1 2"), SceneError);
  EXPECT_THROW(overridden("colour", "1 2 3x"), SceneError);
}

}  // namespace
}  // namespace lampyris
