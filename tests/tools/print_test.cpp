// SPDX-License-Identifier: Apache-2.0
// --cat and --toply: a printed scene renders to the same bits.
#include "command_test_support.h"

namespace lampyris::test {

namespace {

using Print = CommandTest;

/// Comments, an included file, all kinds of blocks and values, and names that look like parameters.
const char* const kScene = R"(# a comment
LookAt 0 -3 1 0 0 0 # another
0 0 1 Camera "perspective" "float fov" 45
Sampler "random" "integer pixelsamples" 4 Integrator "path" PixelFilter "box"
Film "image" "integer xresolution" [24] "integer yresolution" [ 16 ] "string filename" "x.pfm"
TransformTimes 0 1
WorldBegin
CoordinateSystem "a place" LightSource "infinite" "rgb L" [.5 +0.6 7e-1]
AttributeBegin AreaLightSource "diffuse" "rgb L" [4 4 4] "bool twosided" true
Include "lamp.pbrt" AttributeEnd
Texture "tex P" "float" "checkerboard" "float uscale" 3 "float vscale" 3
  "float tex1" 0 "float tex2" 1
MakeNamedMaterial "red one" "string type" "matte" "rgb Kd" [.6 .1 .1]
ObjectBegin "thing" NamedMaterial "red one"
TransformBegin ActiveTransform EndTime Translate 0.1 0 0 ActiveTransform All
Shape "trianglemesh" "integer indices" [0 1 2 2 3 0.0] "point P" [-1 -1 0 1 -1 0.1 1 1 0 -1 1
  0.123456789] "normal N" [0.1 0 1 0 0.1 1 -0.1 0 1 0 -0.1 1] "texture alpha" "tex P"
  "float st" [0 0 1 0 1 1 0 1]
TransformEnd ObjectEnd
ObjectInstance "thing" Rotate 40 1 2 3 ObjectInstance "thing"
CoordSysTransform "a place" Scale .5 .5 .5
Shape "trianglemesh" "integer indices" [0 1 2] "point P" [-1 -1 1 1 -1 1 0 1 2]
Shape "trianglemesh" "integer indices" [0 1 2] "point P" [-1 -1 -1 1 -1 -1 0 1 -2] "vector S"
  [1 0 0 1 0 0 1 0 0]
WorldEnd
)";
const char* const kLamp =
    "Material \"matte\" Shape \"trianglemesh\" \"point3 P\" [-.3 -.3 1.5 .3 -.3 1.5 0 .3 1.5]\n"
    "\"integer indices\" [0 2 1]\n";

TEST_F(Print, PrintedScenesRenderToTheSameBits) {
  write("scene.pbrt", kScene);
  write("lamp.pbrt", kLamp);
  ASSERT_EQ(run("-q -o a.pfm scene.pbrt").code, 0);
  for (const char* option : {"--cat", "--toply", "-cat"}) {
    const CommandResult printed = run(std::string(option) + " scene.pbrt");
    EXPECT_EQ(printed.code, 0) << printed.err;
    EXPECT_EQ(printed.err, "");
    EXPECT_EQ(printed.out.find('#'), std::string::npos);
    EXPECT_EQ(printed.out.find("Include"), std::string::npos);
    write("printed.pbrt", printed.out);
    ASSERT_EQ(run("-q -o b.pfm printed.pbrt").code, 0) << run("printed.pbrt").err << printed.out;
    EXPECT_EQ(read("a.pfm"), read("b.pfm")) << printed.out;
    // What is printed is printed as it is.
    EXPECT_EQ(run(std::string(option) + " printed.pbrt").out, printed.out);
  }
}

TEST_F(Print, MeshesThatPlyFilesHoldAreWrittenBesideTheScene) {
  std::filesystem::create_directory(path("folder"));
  write("folder/scene.pbrt", kScene);
  write("folder/lamp.pbrt", kLamp);
  ASSERT_EQ(run("-q -o a.pfm folder/scene.pbrt").code, 0);
  const CommandResult printed = run("--toply folder/scene.pbrt");
  EXPECT_TRUE(exists("folder/mesh_00001.ply") && exists("folder/mesh_00003.ply"));
  EXPECT_FALSE(exists("folder/mesh_00004.ply"));  // has tangents
  write("folder/printed.pbrt", printed.out);
  ASSERT_EQ(run("-q -o b.pfm folder/printed.pbrt").code, 0);
  EXPECT_EQ(read("a.pfm"), read("b.pfm")) << printed.out;
}

TEST_F(Print, LongListsAreBrokenIntoLines) {
  std::string list;
  for (int i = 0; i < 300; ++i) list += " " + std::to_string(0.123456 * i);
  write("long.pbrt",
        "Camera \"perspective\" \"float screenwindow\" [" + list + "] WorldBegin WorldEnd");
  std::istringstream lines(run("--cat long.pbrt").out);
  size_t count = 0;
  for (std::string line; std::getline(lines, line); ++count) EXPECT_LE(line.size(), 100u);
  EXPECT_GT(count, 20u);
}

TEST_F(Print, FaultsAreErrors) {
  write("broken.pbrt", "WorldBegin\nShap \"sphere\"\n");
  const CommandResult r = run("--cat broken.pbrt");
  EXPECT_EQ(r.code, 1);
  EXPECT_NE(r.err.find("broken.pbrt:2:"), std::string::npos) << r.err;
  EXPECT_EQ(r.out, "");
  EXPECT_EQ(run("--cat missing.pbrt").code, 3);
  EXPECT_EQ(run("--cat tiny.pbrt tiny.pbrt").code, 2);
}

}  // namespace

}  // namespace lampyris::test
