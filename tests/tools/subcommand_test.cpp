// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "core/image.h"
#include "scene/builder.h"
#include "tools/command_test_support.h"
#include "tools/commands.h"

namespace lampyris::test {

namespace {

using Subcommand = CommandTest;

void writeGrey(const std::filesystem::path& path, int width, float value) {
  Image image(width, 4, 3);
  for (float& v : image.data()) v = value;
  writeImageFile(path.string(), image);
}

TEST_F(Subcommand, CompareTellsTheError) {
  writeGrey(path("a.pfm"), 5, 1.5f);
  writeGrey(path("b.pfm"), 5, 1);
  const CommandResult r = run("compare a.pfm b.pfm --out error.png");
  EXPECT_EQ(r.code, 0) << r.err;
  EXPECT_NE(r.out.find("0.25"), std::string::npos) << r.out;
  EXPECT_TRUE(exists("error.png"));
  EXPECT_EQ(run("compare a.pfm b.pfm --error-image error.exr").code, 0);
  EXPECT_TRUE(exists("error.exr"));
  const CommandResult json = run("compare a.pfm b.pfm --json");
  EXPECT_EQ(json.code, 0);
  EXPECT_TRUE(json.out.starts_with("{")) << json.out;
  EXPECT_NE(json.out.find("\"mse\": 0.25"), std::string::npos) << json.out;
  for (const char* other : {"b.exr", "b.hdr", "b.png"}) {
    EXPECT_EQ(run("convert b.pfm " + std::string(other)).code, 0);
    EXPECT_NE(run("compare b.pfm " + std::string(other)).out.find("MSE               0\n"),
              std::string::npos)
        << other;
  }
  EXPECT_EQ(run("compare a.pfm b.pfm --error-image error.txt").code, 2);
  writeGrey(path("c.pfm"), 6, 1);
  EXPECT_EQ(run("compare a.pfm c.pfm").code, 3);
  EXPECT_EQ(run("compare a.pfm missing.pfm").code, 3);
  EXPECT_EQ(run("compare a.pfm").code, 2);
  EXPECT_EQ(run("compare a.pfm b.pfm --outt x.png").code, 2);
}

TEST_F(Subcommand, InfoAndConvert) {
  writeGrey(path("a.pfm"), 5, 0.5f);
  EXPECT_EQ(run("convert a.pfm b.exr").code, 0);
  const CommandResult r = run("info b.exr");
  EXPECT_EQ(r.code, 0) << r.err;
  EXPECT_NE(r.out.find("5 x 4, 3 channels, mean 0.5 0.5 0.5"), std::string::npos) << r.out;
  EXPECT_EQ(run("convert a.pfm b.unknown").code, 2);
  EXPECT_EQ(run("info missing.exr").code, 3);
}

TEST_F(Subcommand, ConvertScalesFlipsAndToneMaps) {
  Image image(2, 2, 4);
  for (size_t i = 0; i < image.data().size(); ++i) image.data()[i] = static_cast<float>(i) / 4;
  writeImageFile(path("a.exr").string(), image);
  ASSERT_EQ(run("convert a.exr b.exr --scale 2 --flipy").code, 0);
  const Image b = readLinearImage(path("b.exr").string());
  for (int y = 0; y < 2; ++y)
    for (int x = 0; x < 2; ++x)
      for (int c = 0; c < 4; ++c)
        EXPECT_EQ(b.at(x, y, c), image.at(x, 1 - y, c) * (c < 3 ? 2.f : 1.f));
  writeGrey(path("grey.pfm"), 3, 4);
  ASSERT_EQ(run("convert grey.pfm white.pfm --tonemap --maxluminance 4").code, 0);
  EXPECT_NEAR(readLinearImage(path("white.pfm").string()).at(0, 0, 1), 1, 1e-5);
  ASSERT_EQ(run("convert grey.pfm dark.pfm --tonemap --maxluminance 1e9").code, 0);
  EXPECT_NEAR(readLinearImage(path("dark.pfm").string()).at(0, 0, 1), 0.8, 1e-5);
  EXPECT_EQ(run("convert grey.pfm b.pfm --scale -1").code, 2);
}

TEST_F(Subcommand, AssembleMakesTheWholeOfCropWindows) {
  ASSERT_EQ(run("-q -o whole.exr tiny.pbrt").code, 0);
  ASSERT_EQ(run("-q --crop 0 0.4 0 1 -o left.exr tiny.pbrt").code, 0);
  ASSERT_EQ(run("-q --crop 0.4 1 0 0.5 -o top.exr tiny.pbrt").code, 0);
  ASSERT_EQ(run("-q --crop 0.4 1 0.5 1 -o low.exr tiny.pbrt").code, 0);
  EXPECT_NE(run("info top.exr").out.find("part of 24 x 16, at 10,0"), std::string::npos);
  EXPECT_EQ(run("info whole.exr").out.find("part of"), std::string::npos);
  const CommandResult r = run("assemble left.exr top.exr low.exr -o all.exr");
  EXPECT_EQ(r.code, 0);
  EXPECT_EQ(r.err, "");
  EXPECT_EQ(readLinearImage(path("all.exr").string()).data(),
            readLinearImage(path("whole.exr").string()).data());
  EXPECT_NE(run("assemble left.exr top.exr -o b.exr").err.find("112 pixels are in no file"),
            std::string::npos);
  EXPECT_NE(run("assemble left.exr left.exr -o b.exr").err.find("160 pixels are in several"),
            std::string::npos);
  writeGrey(path("other.exr"), 5, 1);
  EXPECT_EQ(run("assemble left.exr other.exr -o b.exr").code, 3);
  writeGrey(path("a.pfm"), 24, 1);
  EXPECT_EQ(run("assemble a.pfm -o b.exr").code, 2);
  EXPECT_EQ(run("assemble left.exr").code, 2);
  EXPECT_EQ(run("makesky -o sky.exr").code, 2);
}

TEST_F(Subcommand, HelpSceneKnowsEveryPlugin) {
  EXPECT_EQ(run("help-scene").code, 0);
  EXPECT_EQ(run("help-scene nokind").code, 2);
  EXPECT_EQ(run("help-scene shape nosuchshape").code, 2);
  const CommandResult kind = run("help-scene arealight");
  EXPECT_EQ(kind.code, 0);
  EXPECT_NE(kind.out.find("diffuse"), std::string::npos);
  const CommandResult path = run("help-scene integrator path");
  EXPECT_EQ(path.code, 0);
  EXPECT_NE(path.out.find("maxdepth"), std::string::npos);
  EXPECT_NE(path.out.find("default 5"), std::string::npos) << path.out;
  const std::string reference = sceneReference();
  for (const RegistryInfo* r : allRegistries())
    for (const PluginInfo* p : r->plugins()) {
      EXPECT_NE(reference.find("### `" + p->name + "`"), std::string::npos) << p->name;
      EXPECT_FALSE(p->summary.empty()) << p->name;
      for (const ParameterDeclaration& d : p->schema.declarations()) {
        if (!d.ignoredBecause.empty()) continue;
        SCOPED_TRACE(p->name + " " + d.name);
        EXPECT_TRUE(d.doc.ends_with('.')) << d.doc;
        EXPECT_FALSE(d.typeText().empty());
        EXPECT_TRUE(!d.defaultText.empty() || d.target == TargetType::String);
        EXPECT_FALSE(d.rangeText().empty()) << "declare a range, choices or any()";
        EXPECT_LE(d.min, d.max);
      }
    }
}

TEST_F(Subcommand, ReferencePageIsUpToDate) {
  const std::string file = LAMPYRIS_SOURCE_DIR "/docs/scene-reference.md";
  ASSERT_TRUE(std::filesystem::exists(file));
  EXPECT_EQ(readText(file), sceneReference())
      << "regenerate it: lampyris help-scene --markdown >docs/scene-reference.md";
}

}  // namespace

}  // namespace lampyris::test
