// SPDX-License-Identifier: Apache-2.0
// Scenes that ask for what cannot be: each ends with a message that names the place, soon, and
// within 4 GB of address space.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include "tools/command_test_support.h"

namespace lampyris::test {

namespace {

namespace fs = std::filesystem;

class HostileInput : public CommandTest {
 protected:
  static std::string world(const std::string& text) {
    return "Film \"image\" \"integer xresolution\" 8 \"integer yresolution\" 8\n"
           "WorldBegin\nLightSource \"point\" \"point from\" [0 0 -3]\n" +
           text + "\nWorldEnd\n";
  }
  /// Limits address space (in KiB; the address sanitizer's own is larger than any limit) and
  /// processor time (in seconds).
  CommandResult runLimited(const std::string& arguments) const {
#ifdef __SANITIZE_ADDRESS__
    const char* const limits = "ulimit -t 60";
#else
    const char* const limits = "ulimit -v 4000000 && ulimit -t 10";
#endif
    return run("--quiet --threads 2 --spp 1 -o a.pfm " + arguments, limits);
  }
  /// The message of a scene of this text, whose exit code must be that of a scene error.
  std::string errorOf(const std::string& text) const {
    write("a.pbrt", text);
    const CommandResult r = runLimited("a.pbrt");
    EXPECT_EQ(r.code, 1) << text.substr(0, 200) << r.err;
    return r.err.substr(0, 1000);
  }
  void expectError(const std::string& text, const std::string& message) const {
    const std::string error = errorOf(text);
    EXPECT_NE(error.find(message), std::string::npos) << error;
  }
};

TEST_F(HostileInput, IncludesWithoutEnd) {
  expectError(world("Include \"a.pbrt\""), "a.pbrt:4:1: error: \"a.pbrt\" includes itself");
  write("b.pbrt", "Include \"./c.pbrt\"\n");
  write("c.pbrt", "Identity Include \"b.pbrt\"\n");
  expectError(world("Include \"b.pbrt\""), "c.pbrt:1:10: error: \"b.pbrt\" includes itself");
  fs::create_symlink("l0.pbrt", path("l1.pbrt"));
  write("l0.pbrt", "Include \"l1.pbrt\"\n");
  expectError(world("Include \"l0.pbrt\""), "includes itself");
  // Each level twice: 2⁴⁰ in all.
  for (int i = 0; i < 40; ++i) {
    const std::string next = "Include \"n" + std::to_string(i + 1) + ".pbrt\"\n";
    write("n" + std::to_string(i) + ".pbrt", next + next);
  }
  write("n40.pbrt", "Identity\n");
  expectError(world("Include \"n0.pbrt\""), "included more than 100000 times");
}

TEST_F(HostileInput, NestedBlocks) {
  for (const char* begin : {"AttributeBegin\n", "TransformBegin\n"}) {
    std::string nested;
    for (int i = 0; i < 1'000'000; ++i) nested += begin;
    expectError(world(nested), "a.pbrt:10004:1: error: blocks are nested deeper than 10000 levels");
  }
}

/// Each texture names the one before it twice: 2³⁹ values for one.
TEST_F(HostileInput, TexturesOfTextures) {
  std::string text = "Texture \"t0\" \"spectrum\" \"constant\"\n";
  for (int i = 1; i < 40; ++i)
    text += "Texture \"t" + std::to_string(i) + "\" \"spectrum\" \"scale\" \"texture tex1\" \"t" +
            std::to_string(i - 1) + "\" \"texture tex2\" \"t" + std::to_string(i - 1) + "\"\n";
  expectError(world(text + "Material \"matte\" \"texture Kd\" \"t39\"\nShape \"sphere\""),
              "a.pbrt:17:1: error: one value of this texture takes 16382 values of textures");
}

TEST_F(HostileInput, NumbersThatCannotBe) {
  const auto triangle = [](const std::string& indices, const std::string& point) {
    return world("Shape \"trianglemesh\" \"integer indices\" [" + indices +
                 "] \"point P\" [0 0 0  1 0 0  " + point + "]");
  };
  expectError(triangle("0 1 7", "0 1 0"), "a.pbrt:4:1: error: trianglemesh: index 7 is beyond");
  expectError(triangle("0 1 -1", "0 1 0"), "a.pbrt:4:1: error: trianglemesh: index -1 is negative");
  expectError(triangle("0 1 2", "0 1 nan"), "a number or ], got \"nan\"");
  expectError(triangle("0 1 2", "0 1 1e99"), "\"1e99\" is too large");
  for (const char* shape : {"sphere", "disk", "cylinder", "cone", "paraboloid"})
    expectError(world("Shape \"" + std::string(shape) + "\" \"float radius\" -1"),
                "parameter \"radius\": -1 is below 0");
  expectError(
      "Film \"image\" \"integer xresolution\" 1000000 \"integer yresolution\" 1000000\n"
      "WorldBegin\nWorldEnd\n",
      "a.pbrt:1:14: error: an image of 1000000 x 1000000 pixels needs about 59604.6 GiB of memory; "
      "the limit is ");
}

/// What has no area gives no light, and no error.
TEST_F(HostileInput, EmittersWithoutArea) {
  const std::string light = "AreaLightSource \"diffuse\" \"rgb L\" [5 5 5]\n";
  for (const char* shape : {"sphere", "disk", "cylinder", "cone", "paraboloid"}) {
    write("a.pbrt", world(light + "Shape \"" + shape + "\" \"float radius\" 0"));
    const CommandResult r = runLimited("a.pbrt");
    EXPECT_EQ(r.code, 0) << shape << r.err;
  }
  write("a.pbrt", world(light + "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 0 0] "
                                "\"point P\" [0 0 5  1 0 5  2 0 5]"));
  EXPECT_EQ(runLimited("a.pbrt").code, 0);
}

TEST_F(HostileInput, MeshFiles) {
  const std::string header =
      "ply\nformat binary_little_endian 1.0\nelement vertex 1000000000\nproperty float x\n"
      "property float y\nproperty float z\nelement face 1000000000\n"
      "property list uchar int vertex_indices\nend_header\n";
  write("huge.ply", header);
  expectError(world("Shape \"plymesh\" \"string filename\" \"huge.ply\""),
              "a.pbrt:4:1: error: huge.ply: it ends before the data");
  write("nan.ply",
        "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"
        "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
        "0 0 0\n1 0 nan\n0 1 0\n3 0 1 2\n");
  expectError(world("Shape \"plymesh\" \"string filename\" \"nan.ply\""),
              "nan.ply: the position of vertex 1 is not finite");
}

/// Nothing but files is read: neither folders, nor what waits or never ends.
TEST_F(HostileInput, WhatIsNoFile) {
  struct Use {
    std::string ending, before, after;
  };
  const std::vector<Use> uses = {
      {".pbrt", "Include \"", "\""},
      {".ply", "Shape \"plymesh\" \"string filename\" \"", "\""},
      {".exr", "LightSource \"infinite\" \"string mapname\" \"", "\""},
      {".png", "Texture \"t\" \"color\" \"imagemap\" \"string filename\" \"",
       "\"\nMaterial \"matte\" \"texture Kd\" \"t\"\nShape \"sphere\""},
      {".spd", "Material \"matte\" \"spectrum Kd\" \"", "\"\nShape \"sphere\""},
      {".bsdf", "Material \"fourier\" \"string bsdffile\" \"", "\"\nShape \"sphere\""},
  };
  for (const Use& use : uses) {
    fs::create_directory(path("folder" + use.ending));
    fs::create_symlink("/dev/zero", path("zero" + use.ending));
    ASSERT_EQ(mkfifo(path("pipe" + use.ending).c_str(), 0600), 0);
    for (const char* name : {"folder", "zero", "pipe"})
      expectError(world(use.before + name + use.ending + use.after),
                  "cannot read \"" + std::string(name) + use.ending + "\": not a regular file");
    expectError(world(use.before + "gone" + use.ending + use.after),
                "cannot open \"gone" + use.ending + "\": No such file");
  }
  write("a.lens", "Camera \"realistic\" \"string lensfile\" \"pipe.ply\"\nWorldBegin\nWorldEnd\n");
  EXPECT_EQ(runLimited("a.lens").code, 1);
  for (const char* name : {"folder.pbrt", "zero.pbrt", "pipe.pbrt"}) {
    const CommandResult r = runLimited(name);
    EXPECT_EQ(r.code, 3);
    EXPECT_NE(r.err.find("not a regular file"), std::string::npos) << r.err;
  }
  const CommandResult endless = runLimited("- </dev/zero");
  EXPECT_EQ(endless.code, 3);
  EXPECT_NE(endless.err.find("standard input has no end"), std::string::npos) << endless.err;
}

/// A rename would put the image in the place of the pipe; of a device, for root.
TEST_F(HostileInput, NothingButFilesIsWritten) {
  ASSERT_EQ(mkfifo(path("pipe.pfm").c_str(), 0600), 0);
  fs::create_symlink("pipe.pfm", path("link.pfm"));
  for (const char* option : {"-o pipe.pfm", "-o link.pfm", "--checkpoint pipe.pfm -o b.pfm"}) {
    const CommandResult r = run(std::string("--quiet tiny.pbrt ") + option);
    EXPECT_EQ(r.code, 3) << option;
    EXPECT_NE(r.err.find("not a regular file"), std::string::npos) << r.err;
    EXPECT_TRUE(fs::is_fifo(path("pipe.pfm"))) << option;
  }
}

}  // namespace

}  // namespace lampyris::test
