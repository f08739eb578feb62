// SPDX-License-Identifier: Apache-2.0
#include "core/registry.h"

#include <gtest/gtest.h>

namespace lampyris {
namespace {

struct Animal {
  virtual ~Animal() = default;
  int legs = 0;
};
struct Place {
  int bonus = 0;
};

struct CatParameters {
  int legs = 4;
  void declare(Declaration& d) {
    d.add("legs", legs, "Legs.").alias("paws");
    d.ignored("tail", "cats keep theirs");
  }
};
struct BirdParameters {
  int wings = 2;
  void declare(Declaration& d) { d.add("wings", wings, "Wings."); }
};

std::unique_ptr<Animal> createCat(const CatParameters& p, const Place& place) {
  auto a = std::make_unique<Animal>();
  a->legs = p.legs + place.bonus;
  return a;
}
std::unique_ptr<Animal> createBird(const BirdParameters&, const Place&) {
  return std::make_unique<Animal>();
}

const Registry<Animal, Place>& animals() {
  static const Registry<Animal, Place> registry("animal",
                                                {makePlugin("cat", "Purrs.", createCat, {"kitty"}),
                                                 makePlugin("bird", "Sings.", createBird)});
  return registry;
}

Parameter parameter(std::string_view name, std::span<const int32_t> values) {
  Parameter p;
  p.name = name;
  p.type = ParameterType::Integer;
  p.integers = values;
  return p;
}

TEST(Registry, FindsNamesAndAliases) {
  EXPECT_EQ(animals().find("cat")->summary, "Purrs.");
  EXPECT_EQ(animals().find("kitty"), animals().find("cat"));
  EXPECT_EQ(animals().find("dog"), nullptr);
  EXPECT_EQ(animals().names(), (std::vector<std::string>{"cat", "kitty", "bird"}));
  EXPECT_TRUE(animals().knowsParameter("paws"));
  EXPECT_TRUE(animals().knowsParameter("wings"));
  EXPECT_FALSE(animals().knowsParameter("fins"));
  EXPECT_EQ(animals().plugins().size(), 2u);
  EXPECT_EQ(animals().kind(), "animal");
}

TEST(Registry, UnknownNamesAreErrorsWithAGuess) {
  try {
    animals().get("birt", {3, 9});
    FAIL();
  } catch (const SceneError& e) {
    EXPECT_STREQ(e.what(), "unknown animal \"birt\"; did you mean \"bird\"?");
    EXPECT_EQ(e.location.offset, 9u);
  }
  EXPECT_THROW(animals().get("", {}), SceneError);
}

TEST(Registry, CreatesWithParametersAndContext) {
  const int32_t three[] = {3};
  const Parameter p = parameter("paws", three);
  EXPECT_EQ(animals().get("kitty", {}).create({{&p, 1}, {}}, Place{10})->legs, 13);
  EXPECT_EQ(animals().get("cat", {}).create({}, Place{})->legs, 4);
}

class UnknownParameters : public testing::Test {
 protected:
  void check(std::string_view name) {
    const int32_t one[] = {1};
    const Parameter p = parameter(name, one);
    const Schema* schema = &animals().find("cat")->schema;
    checkUnknownParameters({{&p, 1}, {}}, {&schema, 1}, animals(), "cat", diagnostics_);
  }
  SourceFiles files_;
  std::vector<std::string> warnings_;
  Diagnostics diagnostics_{files_, [this](const std::string& t) { warnings_.push_back(t); }};
};

TEST_F(UnknownParameters, KnownOnesAreSilent) {
  check("legs");
  check("paws");
  EXPECT_TRUE(warnings_.empty());
}

TEST_F(UnknownParameters, IgnoredOnesWarnOnce) {
  check("tail");
  check("tail");
  EXPECT_EQ(warnings_, (std::vector<std::string>{"warning: parameter \"tail\" of animal \"cat\" "
                                                 "has no effect: cats keep theirs"}));
}

TEST_F(UnknownParameters, ForeignOnesWarn) {
  check("fins");
  check("wings");  // of another plugin of the kind
  ASSERT_EQ(warnings_.size(), 2u);
  EXPECT_EQ(warnings_[0], "warning: unknown parameter \"fins\" for animal \"cat\"; it is ignored");
}

TEST_F(UnknownParameters, MisspeltOnesAreErrors) {
  try {
    check("legz");
    FAIL();
  } catch (const SceneError& e) {
    EXPECT_STREQ(e.what(), "unknown parameter \"legz\" for animal \"cat\"; did you mean \"legs\"?");
  }
  EXPECT_THROW(check("Legs"), SceneError);
}

}  // namespace
}  // namespace lampyris
