// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "core/image.h"
#include "tools/command_test_support.h"

namespace lampyris::test {

namespace {

using Cache = CommandTest;

/// A floor below a lamp that shines upwards onto a ceiling.
std::string room(const std::string& camera) {
  return "LookAt 0 -3 1  0 0 1  0 0 1\nCamera \"" + camera +
         "\" \"float fov\" 60\nSampler \"random\"\nIntegrator \"path\"\n"
         "Film \"image\" \"integer xresolution\" 32 \"integer yresolution\" 32\nWorldBegin\n"
         "Material \"matte\"\n"
         "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3 4 5 6 4 6 7] \"point P\" "
         "[-2 -2 0 2 -2 0 2 2 0 -2 2 0 -2 -2 2 2 -2 2 2 2 2 -2 2 2]\n"
         "AreaLightSource \"diffuse\" \"rgb L\" [9 9 9]\n"
         "Shape \"trianglemesh\" \"integer indices\" [0 1 2] \"point P\" [0 0 1 1 0 1 0 1 1]\n"
         "WorldEnd\n";
}

TEST_F(Cache, DrawsRecords) {
  write("room.pbrt", room("perspective"));
  const CommandResult r = run("cache room.pbrt --dim 0 --spp 8 -o records.exr");
  ASSERT_EQ(r.code, 0) << r.err;
  for (const char* word : {"records", "memory", "look-ups", "share", "learning", "picture"})
    EXPECT_NE(r.out.find(word), std::string::npos) << word << r.out;
  // On a black image there is nothing but records.
  const Image image = readLinearImage(path("records.exr"));
  size_t marked = 0;
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) marked += image.rgb(x, y).maxComponent() > 0;
  EXPECT_GT(marked, 20u);
  EXPECT_LT(marked, 32u * 32u);
}

TEST_F(Cache, Errors) {
  write("round.pbrt", room("environment"));
  EXPECT_EQ(run("cache round.pbrt").code, 1);
  write("room.pbrt", room("perspective"));
  EXPECT_EQ(run("cache room.pbrt -o records.txt").code, 2);
  EXPECT_EQ(run("cache").code, 2);
  EXPECT_EQ(run("cache missing.pbrt").code, 3);
}

}  // namespace

}  // namespace lampyris::test
