// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <filesystem>

#include "core/error.h"
#include "tools/checkpoint.h"
#include "tools/progress.h"

namespace lampyris {

namespace {

TEST(Progress, DurationsAndCounts) {
  EXPECT_EQ(formatDuration(1.53), "1.5 s");
  EXPECT_EQ(formatDuration(125), "2 min 05 s");
  EXPECT_EQ(formatDuration(3 * 3600 + 7 * 60), "3 h 07 min");
  EXPECT_EQ(formatCount(950), "950");
  EXPECT_EQ(formatCount(1234), "1.2k");
  EXPECT_EQ(formatCount(3.4e6), "3.4M");
}

TEST(Fingerprint, EveryByteAndEveryBoundaryCounts) {
  const auto of = [](std::initializer_list<std::string_view> parts) {
    Fingerprint f;
    for (const auto p : parts) f.add(p);
    return f.value();
  };
  EXPECT_EQ(of({"abc", "def"}), of({"abc", "def"}));
  EXPECT_NE(of({"abc", "def"}), of({"abcd", "ef"}));
  EXPECT_NE(of({"abc"}), of({"abd"}));
  EXPECT_NE(of({"a"}), of({std::string_view("a\0", 2)}));
  EXPECT_NE(of({}), of({""}));
}

TEST(Checkpoint, SurvivesTheFile) {
  const std::string path =
      (std::filesystem::temp_directory_path() / "lampyris-checkpoint-test").string();
  writeCheckpoint(path,
                  {7, 3, 20, {4, 16}, 12, std::string("film\0bytes", 10), "what was learned"});
  const Checkpoint c = readCheckpoint(path);
  EXPECT_EQ(c.fingerprint, 7u);
  EXPECT_EQ(c.seed, 3u);
  EXPECT_EQ(c.whole, 20u);
  EXPECT_EQ(c.range, (SampleRange{4, 16}));
  EXPECT_EQ(c.samples, 12u);
  EXPECT_EQ(c.film, std::string("film\0bytes", 10));
  std::filesystem::remove(path);
  EXPECT_THROW(readCheckpoint(path), IoError);
  EXPECT_THROW(writeCheckpoint("/nonexistent/folder/c", c), IoError);
}

}  // namespace

}  // namespace lampyris
