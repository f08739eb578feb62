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
