// SPDX-License-Identifier: Apache-2.0
// What is too large for the memory is an error that names it, before it is asked for.
#include "core/memory.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "tools/command_test_support.h"

// The sanitizers' own memory is larger than any limit.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)

namespace lampyris::test {

namespace {

class Memory : public CommandTest {
 protected:
  /// The first line that a render within 1 GB of address space says; its exit code must be that of
  /// a scene error.
  std::string errorOf(const std::string& arguments) const {
    const CommandResult r =
        run("-q --threads 2 --spp 1 -o a.exr " + arguments, "ulimit -v 1000000 && ulimit -t 20");
    EXPECT_EQ(r.code, 1) << arguments << r.err;
    EXPECT_FALSE(exists("a.exr"));
    return r.err.substr(0, r.err.find('\n'));
  }
  static void expectTooLarge(const std::string& error, const std::string& what) {
    EXPECT_TRUE(error.starts_with(what + " of memory; the limit is ")) << error;
    EXPECT_TRUE(error.ends_with(" (ulimit -v)")) << error;
  }
  /// The scene with another shape.
  void writeWith(const std::string& shape) const {
    std::string text = scene("\"mlt\"");
    const size_t at = text.find("Shape");
    write("other.pbrt", text.replace(at, text.find('\n', at) - at, shape));
  }
  double statistic(const std::string& name) const {
    return nlohmann::json::parse(read("s.json"))["statistics"]["memory"][name];
  }
};

TEST_F(Memory, WhatIsTooLargeIsNamed) {
  write("wide.pbrt",
        "Film \"image\" \"integer xresolution\" 5000\n\"integer yresolution\" 4000\nWorldBegin\n"
        "WorldEnd\n");
  expectTooLarge(errorOf("wide.pbrt"),
                 "wide.pbrt:1:14: error: an image of 5000 x 4000 pixels needs about 1.2 GiB");
  writeWith("Shape \"sphere\"");
  expectTooLarge(errorOf("-D integrator.bootstrapsamples=100000000 other.pbrt"),
                 "other.pbrt:1:1: error: integrator \"mlt\" needs about 4.5 GiB");
  writeWith(
      "Shape \"loopsubdiv\" \"integer levels\" 12 \"integer indices\" [0 1 2] \"point P\" [0 0 0 1 "
      "0 0 0 1 0]");
  expectTooLarge(errorOf("other.pbrt"),
                 "other.pbrt:11:1: error: subdivision into 1.68e+07 triangles needs about 3.9 GiB");
  std::string curve = "Shape \"curve\" \"float splitdepth\" 10 \"point P\" [";
  for (int i = 0; i < 3 * 8000 + 1; ++i) curve += fmt::format("{} {} 0 ", i, i % 7);
  writeWith(curve + "]");
  expectTooLarge(
      errorOf("other.pbrt"),
      "other.pbrt:11:1: error: the ray tracing structure of 0 triangles, 8192000 elements "
      "of other shapes (of this shape: 8192000) and 0 instances needs about 1.3 GiB");
}

TEST_F(Memory, TheEstimateIsNearThePeak) {
  const std::string size = "-D film.xresolution=1000 -D film.yresolution=800 --spp 1 -q ";
  for (const char* options :
       {"-D integrator=path", "-D integrator=bdpt",
        "-D integrator=path --aov albedo,normal,variance", "-D integrator=path --checkpoint c"}) {
    EXPECT_EQ(run(size + options + " --stats s.json -o a.exr tiny.pbrt").code, 0);
    const double ratio = statistic("estimated bytes") / statistic("peak bytes");
    EXPECT_GT(ratio, 0.75) << options;
    EXPECT_LT(ratio, 1.6) << options;
  }
}

TEST_F(Memory, LimitsOfTheProcessCount) {
  EXPECT_GT(memoryLimit().bytes, 0);
  limitMemory(1e6);
  EXPECT_EQ(memoryLimit().bytes, 1e6);
  limitMemory(std::numeric_limits<double>::infinity());
  EXPECT_GT(peakMemory(), 1e6);
  EXPECT_GE(peakMemory(), usedMemory());
}

}  // namespace
}  // namespace lampyris::test

#endif
