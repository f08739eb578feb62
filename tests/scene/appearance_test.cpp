// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "scene_test.h"

namespace lampyris::test {
namespace {

TEST(Appearance, MaterialsAreSharedUnlessAShapeReplacesAParameter) {
  Reader r;
  const auto job = r.build(
      world(std::string("Material \"nosuchmaterial\" MakeNamedMaterial \"unused\" \"string type\" "
                        "\"nosuchmaterial\" Material \"matte\" ") +
            kTriangle + kTriangle + kTriangle + "\"rgb Kd\" [1 0 0] Material \"\" " + kTriangle +
            "Material \"none\" " + kTriangle));
  EXPECT_EQ(job->scene.materials.size(), 2u);
  EXPECT_TRUE(r.warnings.empty()) << r.warnings[0];
}

TEST(Appearance, MixFindsNamedMaterialsOfItsPlace) {
  const std::string named =
      "MakeNamedMaterial \"a\" \"string type\" \"mirror\" MakeNamedMaterial \"b\" \"string type\" "
      "\"matte\" ";
  const std::string mix =
      "Material \"mix\" \"string namedmaterial1\" \"a\" \"string namedmaterial2\" \"b\" ";
  Reader r;
  EXPECT_EQ(r.build(world(named + mix + kTriangle))->scene.materials.size(), 3u);
  EXPECT_NE(
      buildError(world(mix + named + kTriangle)).find("named material \"a\" is not defined here"),
      std::string::npos);
  // A mixture cannot contain itself: its name begins to hold after it.
  EXPECT_NE(buildError(world("MakeNamedMaterial \"m\" \"string type\" \"mix\" \"string "
                             "namedmaterial1\" \"m\" \"string namedmaterial2\" \"m\" "
                             "NamedMaterial \"m\" " +
                             std::string(kTriangle)))
                .find("named material \"m\" is not defined here"),
            std::string::npos);
  std::string deep = "MakeNamedMaterial \"m\" \"string type\" \"matte\"\n";
  for (int i = 0; i < 2000; ++i)
    deep +=
        "MakeNamedMaterial \"m\" \"string type\" \"mix\" \"string namedmaterial1\" \"m\" "
        "\"string namedmaterial2\" \"m\"\n";
  EXPECT_NE(buildError(world(deep + "NamedMaterial \"m\" " + kTriangle)).find("500 levels"),
            std::string::npos);
}

TEST(Appearance, TexturesAreBuiltWhenUsed) {
  Reader r;
  const auto job = r.build(world(
      std::string("Texture \"unused\" \"spectrum\" \"imagemap\" \"string filename\" \"no.png\" "
                  "Texture \"t\" \"spectrum\" \"constant\" \"rgb value\" [1 0 0] Material "
                  "\"matte\" \"texture Kd\" \"t\" ") +
      kTriangle + kTriangle));
  EXPECT_EQ(job->scene.spectrumTextures.size(), 1u);
  EXPECT_NE(buildError(world("Texture \"t\" \"float\" \"constant\" Material \"matte\" \"texture "
                             "Kd\" \"t\" " +
                             std::string(kTriangle)))
                .find("unknown spectrum texture \"t\": there is a float texture of that name"),
            std::string::npos);
  EXPECT_NE(buildError(world("Texture \"stripes\" \"color\" \"constant\" Material \"matte\" "
                             "\"texture Kd\" \"stripe\" " +
                             std::string(kTriangle)))
                .find("unknown spectrum texture \"stripe\"; did you mean \"stripes\"?"),
            std::string::npos);
}

TEST(Appearance, AlphaIsATextureOrZero) {
  const auto alphaOf = [](const std::string& parameters) {
    Reader r;
    const auto job = r.build(world("Texture \"t\" \"float\" \"constant\" \"float value\" 1 " +
                                   std::string(kTriangle) + parameters));
    const auto hit = job->scene.geometry->intersect({{.2f, .2f, 5}, {0, 0, -1}});
    if (!hit) return std::string("passed");
    const Primitive& p = job->scene.geometry->primitive(*hit);
    return std::string(p.alpha ? "alpha" : "") + (p.shadowAlpha ? "shadow" : "");
  };
  EXPECT_EQ(alphaOf(""), "");
  EXPECT_EQ(alphaOf("\"texture alpha\" \"t\""), "alpha");
  EXPECT_EQ(alphaOf("\"texture shadowalpha\" \"t\""), "shadow");
  EXPECT_EQ(alphaOf("\"float alpha\" .5"), "");
  EXPECT_EQ(alphaOf("\"float alpha\" 0"), "passed");
  EXPECT_EQ(alphaOf("\"float shadowalpha\" 0"), "shadow");
}

TEST(Appearance, SpectrumFilesAreRead) {
  const TemporaryFolder folder;
  folder.write("spds/flat.spd", "# flat\n400 2 # at 400 nm\n700 2\n");
  folder.write("odd.spd", "400 2 700");
  folder.write("text.spd", "400 two");
  const auto lightPower = [&folder](const std::string& intensity) {
    Reader r;
    return r.build(world("LightSource \"point\" \"spectrum I\" " + intensity), {}, folder.path())
        ->scene.lightTable[0]
        .light->power(0);
  };
  EXPECT_EQ(lightPower("\"spds/flat.spd\""), lightPower("[400 2 700 2]"));
  const auto error = [&folder](const std::string& file) {
    return buildError(world("LightSource \"point\" \"spectrum I\" " + file), {}, folder.path());
  };
  EXPECT_EQ(error("\"odd.spd\""),
            "1:10: a spectrum file holds pairs of a wavelength and a value, "
            "this one 3 numbers");
  EXPECT_EQ(error("\"text.spd\""), "1:5: expected a wavelength or a value, got \"two\"");
  EXPECT_NE(error("\"missing.spd\"").find("missing.spd"), std::string::npos);
  EXPECT_EQ(error("\"missing.spd\"").substr(0, 6), "3:21: ");
  EXPECT_EQ(error("[\"odd.spd\" \"text.spd\"]"),
            "3:21: parameter \"I\": expected one spectrum file, got 2");
}

}  // namespace
}  // namespace lampyris::test
