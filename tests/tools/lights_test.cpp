// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "tools/command_test_support.h"
#include "tools/light_tree_svg.h"

namespace lampyris::test {

namespace {

using Lights = CommandTest;

std::string lightScene() {
  return "Camera \"perspective\"\nWorldBegin\n"
         "LightSource \"infinite\"\nLightSource \"distant\"\n"
         "LightSource \"point\" \"point from\" [0 0 0]\n"
         "LightSource \"point\" \"point from\" [4 0 0] \"rgb I\" [2 2 2]\n"
         "LightSource \"spot\" \"point from\" [0 3 0]\n"
         "AreaLightSource \"diffuse\"\n"
         "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3]"
         " \"point P\" [0 0 5 1 0 5 1 1 5 0 1 5]\nWorldEnd\n";
}

TEST_F(Lights, TellsWhatThereIs) {
  write("lights.pbrt", lightScene());
  const CommandResult text = run("lights lights.pbrt");
  EXPECT_EQ(text.code, 0) << text.err;
  for (const char* word : {"point", "spot", "area", "distant", "infinite", "SAOH", "depth"})
    EXPECT_NE(text.out.find(word), std::string::npos) << word << text.out;
  const CommandResult r = run("lights lights.pbrt --json");
  EXPECT_EQ(r.code, 0) << r.err;
  const auto json = nlohmann::json::parse(r.out);
  EXPECT_EQ(json["lights"], 6);
  EXPECT_EQ(json["kinds"]["point"]["lights"], 2);
  EXPECT_EQ(json["kinds"]["spot"]["lights"], 1);
  EXPECT_EQ(json["kinds"]["area"]["objects"], 1);
  EXPECT_EQ(json["kinds"]["area"]["lights"], 1);
  EXPECT_EQ(json["kinds"]["distant"]["lights"], 1);
  EXPECT_EQ(json["kinds"]["infinite"]["lights"], 1);
  EXPECT_NEAR(json["kinds"]["point"]["power"], 3 * 4 * M_PI, 1e-3);
  EXPECT_EQ(json["tree"]["lights"], 4);
  EXPECT_EQ(json["tree"]["nodes"], 7);
  EXPECT_GT(json["flux"]["effectiveLights"], 1);
  EXPECT_LT(json["flux"]["effectiveLights"], 4);
  EXPECT_NEAR(json["flux"]["most"], 8 * M_PI, 1e-3);
}

TEST_F(Lights, DrawsTheTree) {
  write("lights.pbrt", lightScene());
  EXPECT_EQ(run("lights lights.pbrt --out tree.svg --levels 2").code, 0);
  const std::string svg = read("tree.svg");
  EXPECT_TRUE(svg.starts_with("<svg")) << svg;
  EXPECT_TRUE(svg.ends_with("</svg>\n"));
  EXPECT_NE(svg.find("prefers-color-scheme: dark"), std::string::npos);
  EXPECT_NE(svg.find("depth 1"), std::string::npos);
  EXPECT_EQ(svg.find("depth 2: "), std::string::npos);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(svg.find("inf"), std::string::npos);
}

TEST_F(Lights, ScenesWithFewLights) {
  write("none.pbrt", "Camera \"perspective\"\nWorldBegin\nWorldEnd\n");
  EXPECT_NE(run("lights none.pbrt --out a.svg").out.find("no lights"), std::string::npos);
  write("sky.pbrt", "Camera \"perspective\"\nWorldBegin\nLightSource \"infinite\"\nWorldEnd\n");
  EXPECT_NE(run("lights sky.pbrt --out b.svg").out.find("there is no tree"), std::string::npos);
  EXPECT_EQ(run("lights sky.pbrt --json").code, 0);
  write("one.pbrt", "Camera \"perspective\"\nWorldBegin\nLightSource \"point\"\nWorldEnd\n");
  EXPECT_EQ(run("lights one.pbrt --out c.svg").code, 0);
  for (const char* file : {"a.svg", "b.svg", "c.svg"}) {
    EXPECT_TRUE(read(file).ends_with("</svg>\n")) << file;
    EXPECT_EQ(read(file).find("nan"), std::string::npos) << file;
  }
}

TEST_F(Lights, Errors) {
  write("broken.pbrt", "WorldBegin\nLightSource \"poin\"\nWorldEnd\n");
  const CommandResult broken = run("lights broken.pbrt");
  EXPECT_EQ(broken.code, 1);
  EXPECT_NE(broken.err.find("broken.pbrt:2:"), std::string::npos) << broken.err;
  EXPECT_EQ(run("lights").code, 2);
  EXPECT_EQ(run("lights tiny.pbrt --out tree.png").code, 2);
  EXPECT_EQ(run("lights tiny.pbrt --levels 0").code, 2);
  EXPECT_EQ(run("lights tiny.pbrt --outt a.svg").code, 2);
  EXPECT_EQ(run("lights missing.pbrt").code, 3);
  EXPECT_EQ(run("lights tiny.pbrt --out missing/tree.svg").code, 3);
}

TEST(LightTreeSvg, TitlesAreEscaped) {
  const std::string svg = lightTreeSvg({"a<b>&c\x01.pbrt", "", {}, {}});
  EXPECT_NE(svg.find("a&lt;b&gt;&amp;c.pbrt"), std::string::npos) << svg;
}

}  // namespace

}  // namespace lampyris::test
