// SPDX-License-Identifier: Apache-2.0
#include "tools/render_settings.h"

#include <gtest/gtest.h>

#include "core/error.h"

namespace lampyris {
namespace {

TEST(RenderArguments, LeaveNothingToTheNextCommandLine) {
  RenderArguments parser;
  const auto all = parser.parse({"a.pbrt", "--spp", "4", "-D", "film.scale=2", "--aov", "albedo",
                                 "--quick", "--crop", "0,1,0,0.5", "--checkpoint-interval", "9",
                                 "--samples", "1:3", "-o", "a.part", "--threads", "3"});
  ASSERT_TRUE(all);
  EXPECT_EQ(all->build.overrides.size(), 2U);
  EXPECT_EQ(all->build.cropWindow.size(), 4U);
  EXPECT_THROW(parser.parse({"b.pbrt", "--pixel", "1,2", "--spp", "none"}), UsageError);
  EXPECT_THROW(parser.parse({"b.pbrt", "--pixel", "1,2", "--unknown"}), UsageError);

  const auto plain = parser.parse({"c.pbrt"});
  ASSERT_TRUE(plain);
  EXPECT_EQ(plain->scenes, std::vector<std::string>{"c.pbrt"});
  EXPECT_TRUE(plain->outputs.empty());
  EXPECT_TRUE(plain->build.overrides.empty());
  EXPECT_TRUE(plain->build.cropWindow.empty());
  EXPECT_EQ(plain->build.samplesPerPixel, BuildOptions{}.samplesPerPixel);
  EXPECT_EQ(plain->threads, 0);
  EXPECT_EQ(plain->checkpointInterval, 60);
  EXPECT_FALSE(plain->quick || plain->samples || plain->pixel || plain->print);
}

}  // namespace
}  // namespace lampyris
