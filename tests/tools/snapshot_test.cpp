// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "core/image_layers.h"
#include "tools/arguments.h"
#include "tools/command_test_support.h"
#include "tools/snapshots.h"

namespace lampyris::test {

namespace {

using Snapshots = CommandTest;

nlohmann::json parsed(const std::string& text) { return nlohmann::json::parse(text); }

TEST(SnapshotList, TimesAndSampleCounts) {
  const auto list = parseSnapshots("0.5s,16spp,2s");
  ASSERT_EQ(list.size(), 3u);
  EXPECT_EQ(list[0].name, "0.5s");
  EXPECT_EQ(list[0].stop.seconds, 0.5);
  EXPECT_EQ(list[0].stop.samples, 0u);
  EXPECT_EQ(list[1].stop.samples, 16u);
  EXPECT_EQ(list[2].stop.seconds, 2);
  EXPECT_EQ(snapshotPath("out/a.b.png", "1s"), "out/a.b-1s.exr");
  EXPECT_EQ(snapshotPath("a.exr", "4spp"), "a-4spp.exr");
  for (const char* wrong : {"", "1", "s", "spp", "0s", "-1s", "0spp", "1.5spp", "1s,", ",1s", "1 s",
                            "nans", "infs", "1e99s", "1s,1s", "99999999999spp", "x/y"})
    EXPECT_THROW(parseSnapshots(wrong), UsageError) << wrong;
}

TEST_F(Snapshots, AreTheImagesOfTheirSampleCounts) {
  const CommandResult r =
      run("--spp 12 --snapshots 1spp,5spp,12spp -o out.pfm --stats s.json tiny.pbrt");
  EXPECT_EQ(r.code, 0) << r.err;
  const auto taken = parsed(read("s.json"))["snapshots"];
  ASSERT_EQ(taken.size(), 3u);
  double last = 0;
  for (const int spp : {1, 5, 12}) {
    const auto& entry = taken[spp == 1 ? 0u : spp == 5 ? 1u : 2u];
    const std::string name = std::to_string(spp) + "spp";
    EXPECT_EQ(entry["name"], name);
    EXPECT_EQ(entry["file"], "out-" + name + ".exr");
    EXPECT_EQ(entry["spp"], spp);
    EXPECT_GE(entry["seconds"], last);
    last = entry["seconds"];
    EXPECT_EQ(run("--spp " + std::to_string(spp) + " -o direct.exr tiny.pbrt").code, 0);
    EXPECT_EQ(read("out-" + name + ".exr"), read("direct.exr")) << name;
  }
}

TEST_F(Snapshots, AtTimes) {
  const CommandResult r =
      run("--seconds 0.06 --snapshots 0.02s,0.06s,0.0001s -o out.png --stats s.json --verbose "
          "tiny.pbrt");
  EXPECT_EQ(r.code, 0) << r.err;
  const auto json = parsed(read("s.json"));
  const auto& taken = json["snapshots"];
  ASSERT_EQ(taken.size(), 3u);
  EXPECT_EQ(taken[0]["name"], "0.0001s");
  EXPECT_EQ(taken[2]["name"], "0.06s");
  EXPECT_GE(taken[1]["seconds"], 0.02);
  EXPECT_GE(taken[0]["spp"], 1);
  EXPECT_LE(taken[2]["seconds"], json["seconds"]["render"]);
  for (const char* file : {"out-0.02s.exr", "out-0.06s.exr", "out-0.0001s.exr"})
    EXPECT_TRUE(exists(file)) << file;
}

TEST_F(Snapshots, NotTakenOnes) {
  const CommandResult r = run("--snapshots 2spp,100spp,1000s --stats s.json tiny.pbrt");
  EXPECT_EQ(r.code, 0);
  EXPECT_NE(r.err.find("\"100spp\" was not taken"), std::string::npos) << r.err;
  EXPECT_NE(r.err.find("\"1000s\" was not taken"), std::string::npos) << r.err;
  EXPECT_EQ(parsed(read("s.json"))["snapshots"].size(), 1u);
  EXPECT_TRUE(exists("tiny-2spp.exr"));
}

TEST_F(Snapshots, UsageErrors) {
  EXPECT_EQ(run("--snapshots soon tiny.pbrt").code, 2);
  EXPECT_EQ(run("--spp 4 --snapshots 5spp tiny.pbrt").code, 2);
  EXPECT_EQ(run("--seconds 1 --snapshots 2s tiny.pbrt").code, 2);
  EXPECT_EQ(run("--pixel 1,1 --snapshots 2spp tiny.pbrt").code, 2);
  EXPECT_EQ(run("--noise 0 tiny.pbrt").code, 2);
  EXPECT_EQ(run("--noise little tiny.pbrt").code, 2);
  for (const char* option : {"--noise", "--seconds"})
    for (const char* value : {"nan", "inf", "-inf", ""})
      EXPECT_EQ(run(std::string(option) + " '" + value + "' tiny.pbrt").code, 2) << option << value;
  EXPECT_EQ(run("--seconds -1 tiny.pbrt").code, 2);
}

TEST_F(Snapshots, LimitsEndARenderWhicheverComesFirst) {
  EXPECT_EQ(run("--noise 0.2 --stats s.json tiny.pbrt").code, 0);
  EXPECT_LE(parsed(read("s.json"))["noise"], 0.2);
  EXPECT_GE(parsed(read("s.json"))["statistics"]["render"]["samples per pixel"], 16);
  EXPECT_EQ(run("--noise 1e-9 --seconds 1000 --spp 3 --stats s.json tiny.pbrt").code, 0);
  EXPECT_EQ(parsed(read("s.json"))["statistics"]["render"]["samples per pixel"], 3);
  EXPECT_EQ(run("--noise 1e-9 --seconds 0.05 --stats s.json tiny.pbrt").code, 0);
}

TEST_F(Snapshots, AovsAreLayersOfTheImage) {
  const CommandResult r = run(
      "--aov albedo,normal,depth,samplecount,variance,lightcut,bsdfshare,lightentropy,pathlength,"
      "time --spp 8 --snapshots 2spp -o out.exr tiny.pbrt");
  EXPECT_EQ(r.code, 0) << r.err;
  EXPECT_EQ(run("--spp 8 -o plain.pfm tiny.pbrt").code, 0);
  EXPECT_EQ(run("convert out.exr out.pfm").code, 0);
  EXPECT_EQ(read("out.pfm"), read("plain.pfm"));  // asking changes no pixel
  const std::string file = path("out.exr").string();
  EXPECT_EQ(exrLayerNames(file).size(), 10u);
  const auto layer = [&](const char* name) { return readExrLayer(file, name); };
  // The sphere of radius 0.7 in the middle of the image, seen from (0, −3, 1).
  const Rgb albedo = layer("albedo").rgb(12, 8);
  EXPECT_NEAR(albedo.r, 0.6f, 1e-3f);
  EXPECT_NEAR(albedo.g, 0.5f, 1e-3f);
  EXPECT_NEAR(albedo.b, 0.4f, 1e-3f);
  const Rgb n = layer("N").rgb(12, 8);
  EXPECT_LT(n.g, -0.8f);
  EXPECT_NEAR(layer("depth").at(12, 8, 0), std::sqrt(10.f) - 0.7f, 0.05f);
  EXPECT_EQ(layer("samplecount").at(0, 0, 0), 8);
  EXPECT_GT(layer("variance").at(12, 8, 0), 0);
  EXPECT_EQ(layer("lightcut").at(12, 8, 0), 1);
  EXPECT_GT(layer("lightentropy").at(12, 8, 0), 0.1f);
  EXPECT_GT(layer("bsdfshare").at(12, 8, 0), 0);
  EXPECT_LT(layer("bsdfshare").at(12, 8, 0), 1);
  EXPECT_GE(layer("pathlength").at(12, 8, 0), 2);
  EXPECT_GT(layer("time").at(12, 8, 0), 0);
  // A corner sees the sky only.
  for (const char* name : {"albedo", "N", "depth", "lightcut", "bsdfshare", "lightentropy"})
    EXPECT_EQ(layer(name).at(0, 0, 0), 0) << name;
  EXPECT_EQ(layer("pathlength").at(0, 0, 0), 1);
  EXPECT_EQ(readExrLayer(path("out-2spp.exr").string(), "samplecount").at(3, 3, 0), 2);
}

TEST_F(Snapshots, AovsOfAdaptiveDirectLightingAgreeWithTheStatistics) {
  write("glossy.pbrt",
        "LookAt 0 -3 1  0 0 0  0 0 1\nCamera \"perspective\" \"float fov\" 20\n"
        "Integrator \"directlighting\" \"string strategy\" \"adaptive\"\n"
        "Film \"image\" \"integer xresolution\" 6 \"integer yresolution\" 6\nWorldBegin\n"
        "Material \"metal\" \"float roughness\" 0.2\n"
        "Shape \"disk\" \"float radius\" 9\n"
        "AreaLightSource \"diffuse\"\nTranslate 0 2 1\nShape \"sphere\" \"float radius\" 0.5\n");
  const CommandResult r =
      run("--spp 16 --aov brdfsamples,bsdfdraws --stats s.json -o out.exr glossy.pbrt");
  EXPECT_EQ(r.code, 0) << r.err;
  const auto direct = parsed(read("s.json"))["statistics"]["direct lighting"];
  EXPECT_EQ(direct["share of glossy points"], 1);
  const std::string file = path("out.exr").string();
  const Image samples = readExrLayer(file, "brdfsamples"), share = readExrLayer(file, "bsdfdraws");
  double all = 0, ofBsdf = 0;
  for (int y = 0; y < 6; ++y) {
    for (int x = 0; x < 6; ++x) {
      all += static_cast<double>(samples.at(x, y, 0));
      ofBsdf += static_cast<double>(samples.at(x, y, 0) * share.at(x, y, 0));
    }
  }
  const double mean = direct["BRDF-aware samples a glossy point"];
  EXPECT_GT(mean, 1);
  EXPECT_NEAR(all / 36, mean, 1e-4 * mean);
  EXPECT_NEAR(ofBsdf / all, direct["share of BSDF samples"], 1e-4);
}

TEST_F(Snapshots, AovsAreDeterministicAndResume) {
  const std::string all = "--aov albedo,normal,depth,variance,lightcut,bsdfshare,pathlength ";
  EXPECT_EQ(run(all + "--spp 9 --threads 1 -o a.exr tiny.pbrt").code, 0);
  EXPECT_EQ(run(all + "--spp 9 --threads 3 -o b.exr tiny.pbrt").code, 0);
  EXPECT_EQ(read("a.exr"), read("b.exr"));
  EXPECT_EQ(run(all + "--spp 4 --checkpoint c -o part.exr tiny.pbrt").code, 0);
  EXPECT_EQ(run(all + "--spp 9 --resume c -o b.exr tiny.pbrt").code, 0);
  EXPECT_EQ(read("a.exr"), read("b.exr"));
  EXPECT_EQ(run("--aov albedo --spp 9 --resume c -o b.exr tiny.pbrt").code, 3);
}

TEST_F(Snapshots, AovsOfDirectLighting) {
  write("direct.pbrt", scene("\"directlighting\""));
  EXPECT_EQ(run("--aov albedo,lightcut,lightentropy,depth -o out.exr direct.pbrt").code, 0);
  const std::string file = path("out.exr").string();
  EXPECT_EQ(readExrLayer(file, "lightcut").at(12, 8, 0), 2);  // all lights
  EXPECT_EQ(readExrLayer(file, "lightentropy").at(12, 8, 0), 0);
  EXPECT_NEAR(readExrLayer(file, "albedo").at(12, 8, 0), 0.6f, 1e-3f);
}

TEST_F(Snapshots, AovsThatTheSceneAsksFor) {
  std::string text = scene();
  text.insert(text.find("LookAt"), "  \"string aovs\" [\"depth\" \"normal\"]\n");
  write("layers.pbrt", text);
  EXPECT_EQ(run("-o out.exr layers.pbrt").code, 0);
  EXPECT_EQ(exrLayerNames(path("out.exr").string()), (std::vector<std::string>{"N", "depth"}));
  EXPECT_EQ(run("--aov depth -o out.exr layers.pbrt").code, 0);
  EXPECT_EQ(exrLayerNames(path("out.exr").string()), (std::vector<std::string>{"depth"}));
}

TEST_F(Snapshots, AovErrors) {
  const CommandResult unknown = run("--aov albedo,dept tiny.pbrt");
  EXPECT_EQ(unknown.code, 1);
  EXPECT_NE(unknown.err.find("did you mean \"depth\""), std::string::npos) << unknown.err;
  const CommandResult png = run("--aov depth -o a.png tiny.pbrt");
  EXPECT_EQ(png.code, 0);
  EXPECT_NE(png.err.find("only EXR files can hold them"), std::string::npos) << png.err;
  EXPECT_EQ(run("convert tiny.exr a.png --layer depth").code, 3);
  EXPECT_EQ(run("--aov depth -o d.exr tiny.pbrt").code, 0);
  EXPECT_EQ(run("convert d.exr d.pfm --layer depth").code, 0);
  EXPECT_TRUE(exists("d.pfm"));
  EXPECT_NE(run("info d.exr").out.find("layers: depth"), std::string::npos);
}

}  // namespace

}  // namespace lampyris::test
