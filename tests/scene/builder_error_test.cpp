// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "scene_test.h"

namespace lampyris::test {
namespace {

TEST(BuilderErrors, NamesOfPbrtThatAreNotThereYet) {
  const std::string text = world(
      std::string("Texture \"t\" \"color\" \"ptex\" Material \"matte\" \"texture Kd\" \"t\" ") +
      kTriangle);
  EXPECT_EQ(
      buildError(text),
      "3:1: \"ptex\" is a pbrt-v3 texture that Lampyris cannot read: no Debian package has the "
      "Ptex library; bake the texture to an image and use \"imagemap\"");
}

TEST(BuilderErrors, AreaLightsWithTwoSourcesOfLight) {
  const std::string t = kTriangle;
  const std::string texture = "Texture \"glow\" \"color\" \"constant\" ";
  const std::vector<std::pair<std::string, std::string>> cases = {
      {world(texture + "\nAreaLightSource \"diffuse\" \"rgb L\" [1 1 1] \"texture L\" \"glow\" " +
             t),
       "4:43: the area light has L as a colour and as a texture: give one of them, and \"scale\" "
       "as "
       "a factor"},
      {world(texture +
             "\nAreaLightSource \"diffuse\" \"texture L\" \"glow\" \"string filename\" \"a.exr\" " +
             t),
       "4:1: the area light has both a \"texture L\" and a \"filename\": give one of them "
       "(\"scale\" works with either)"},
      {world("AreaLightSource \"diffuse\" \"texture L\" \"glow\" " + t),
       "3:27: unknown spectrum texture \"glow\""},
  };
  for (const auto& [text, error] : cases) EXPECT_EQ(buildError(text), error) << text;
}

TEST(BuilderErrors, UnknownNames) {
  const std::string t = kTriangle;
  const std::vector<std::pair<std::string, std::string>> cases = {
      {world("\nShape \"spher\""), "4:1: unknown shape \"spher\"; did you mean \"sphere\"?"},
      {world("Material \"mate\" " + t), "3:1: unknown material \"mate\"; did you mean \"matte\"?"},
      {world("LightSource \"pont\""), "3:1: unknown light \"pont\"; did you mean \"point\"?"},
      {world("AreaLightSource \"difuse\" " + t),
       "3:1: unknown area light \"difuse\"; did you mean \"diffuse\"?"},
      {"Sampler \"haltn\" " + world(""),
       "1:1: unknown sampler \"haltn\"; did you mean \"halton\"?"},
      {"PixelFilter \"bx\" " + world(""), "1:1: unknown filter \"bx\"; did you mean \"box\"?"},
      {"Integrator \"pth\" " + world(""),
       "1:1: unknown integrator \"pth\"; did you mean \"path\"?"},
      {"Integrator \"path\" \"string lightsampler\" \"bvhh\" " + world(""),
       "1:19: unknown lightsampler \"bvhh\"; did you mean \"bvh\"?"},
      {"Integrator \"path\" \"integer maxdept\" 3 " + world(""),
       "1:19: unknown parameter \"maxdept\" for integrator \"path\"; did you mean \"maxdepth\"?"},
      {world("Shape \"sphere\" \"float radus\" 3"),
       "3:16: unknown parameter \"radus\" for shape \"sphere\"; did you mean \"radius\"?"},
      {"Integrator \"path\" \"float maxdepth\" 3 " + world(""),
       "1:19: parameter \"maxdepth\": expected integer, got float"},
  };
  for (const auto& [text, error] : cases) EXPECT_EQ(buildError(text), error) << text;
}

TEST(BuilderErrors, ValuesOutOfRange) {
  const std::string t = kTriangle, medium = "MakeNamedMedium \"m\" \"string type\" ";
  const std::string inside = " MediumInterface \"m\" \"\" " + t;
  const std::vector<std::pair<std::string, std::string>> cases = {
      {world(medium + "\"homogeneous\" \"rgb sigma_a\" [0 -1 0]" + inside),
       "3:49: parameter \"sigma_a\": -1 is below 0"},
      {world(medium + "\"heterogeneous\" \"integer nx\" 2 \"float density\" [1 -2]" + inside),
       "3:66: parameter \"density\": -2 is below 0"},
      {world("Material \"glass\" \"float eta\" 0 " + t),
       "3:18: parameter \"eta\": 0 is outside [0.01, 100]"},
      // pbrt-v3 takes these as the nearest end.
      {world("Material \"plastic\" \"rgb Kd\" [-1 0 0] " + t), ""},
      {world("Shape \"disk\" \"float phimax\" 400"), ""},
  };
  for (const auto& [text, error] : cases) EXPECT_EQ(buildError(text), error) << text;
}

/// Of several faults the first of the file is reported, whatever thread finds it.
TEST(BuilderErrors, ReportsTheFirstFault) {
  std::string content;
  for (int i = 0; i < 5000; ++i)
    content += fmt::format("LightSource \"point\" \"float {}\" 1\n", i < 700 ? "scal" : "I");
  content.insert(0, "LightSource \"point\"\n");
  for (int i = 0; i < 5; ++i)
    EXPECT_EQ(buildError(world(content)),
              "4:21: unknown parameter \"scal\" for light \"point\"; did you mean \"scale\"?");
}

TEST(BuilderErrors, DamagedScenesOnlyThrow) {
  const std::string scene =
      "Film \"image\" \"integer xresolution\" [8] \"integer yresolution\" [4]\nLookAt 0 0 5 0 0 0 "
      "0 "
      "1 0 Camera \"perspective\" \"float fov\" 40 Integrator \"path\" WorldBegin LightSource "
      "\"spot\" \"point from\" [0 0 1] \"point to\" [0 0 0] AreaLightSource \"diffuse\" Shape "
      "\"sphere\" Material "
      "\"plastic\" \"rgb Kd\" [1 0 0] " +
      std::string(kTriangle) + "WorldEnd\n";
  ASSERT_EQ(buildError(scene), "");
  size_t errors = 0;
  for (size_t i = 0; i < scene.size(); ++i) {
    std::vector<std::string> damaged = {scene.substr(0, i)};
    for (const char c : {'\0', '"', '7', '-', 'x'}) {
      damaged.push_back(scene);
      damaged.back()[i] = c;
    }
    for (const std::string& text : damaged) {
      // A damaged size may be a valid one that takes long to build.
      if (i > 12 && i < 80) continue;
      Reader r;
      try {
        r.build(text);
      } catch (const SceneError&) {
        ++errors;
      } catch (const IoError&) {
        ++errors;
      }
    }
  }
  EXPECT_GT(errors, scene.size());
}

}  // namespace
}  // namespace lampyris::test
