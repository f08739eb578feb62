// SPDX-License-Identifier: Apache-2.0
#include "core/error.h"

#include <gtest/gtest.h>

#include <thread>
#include <vector>

namespace lampyris {
namespace {

TEST(FormatMessage, PointsAtThePlace) {
  SourceFiles files;
  const uint16_t f = files.add("a.pbrt", "one\ntwo three\nfour");
  EXPECT_EQ(formatMessage(files, {f, 8}, "error", "bad"),
            "a.pbrt:2:5: error: bad\n  two three\n      ^");
  EXPECT_EQ(formatMessage(files, {f, 0}, "warning", "hm"), "a.pbrt:1:1: warning: hm\n  one\n  ^");
  EXPECT_EQ(formatMessage(files, {f, 18}, "error", "end"),
            "a.pbrt:3:5: error: end\n  four\n      ^");
}

TEST(FormatMessage, WithoutAPlace) {
  const SourceFiles files;
  EXPECT_EQ(formatMessage(files, {}, "error", "bad"), "error: bad");
  EXPECT_EQ(formatMessage(files, {7, 0}, "error", "bad"), "error: bad");
}

TEST(FormatMessage, TabsAndReturnsTakeOneColumn) {
  SourceFiles files;
  const uint16_t f = files.add("t", "\t\tab\r\nx");
  EXPECT_EQ(formatMessage(files, {f, 3}, "error", "m"), "t:1:4: error: m\n    ab \n     ^");
}

TEST(FormatMessage, LongLinesAreCut) {
  SourceFiles files;
  std::string text(500, '.');
  text[300] = 'X';
  const uint16_t f = files.add("l", text);
  const std::string message = formatMessage(files, {f, 300}, "error", "m");
  const size_t first = message.find('\n'), second = message.find('\n', first + 1);
  const std::string line = message.substr(first + 1, second - first - 1);
  const std::string caret = message.substr(second + 1);
  EXPECT_EQ(message.substr(0, first), "l:1:301: error: m");
  EXPECT_EQ(line.size(), 102u);
  EXPECT_EQ(line[caret.find('^')], 'X');
  EXPECT_EQ(caret.find('^'), caret.size() - 1);
}

TEST(FormatMessage, EveryOffsetIsSafe) {
  SourceFiles files;
  std::string text(150, 'a');
  text += "\n\n" + std::string(90, 'b');
  const uint16_t f = files.add("l", text);
  const uint16_t empty = files.add("e", "");
  for (uint32_t at = 0; at < text.size() + 5; ++at) {
    const std::string m = formatMessage(files, {f, at}, "error", "m");
    const size_t second = m.rfind('\n'), first = m.rfind('\n', second - 1);
    const std::string line = m.substr(first + 1, second - first - 1);
    EXPECT_LE(m.size() - second - 1, line.size() + 1) << at;
  }
  EXPECT_EQ(formatMessage(files, {empty, 0}, "error", "m"), "e:1:1: error: m\n  \n  ^");
}

TEST(Nearest, FindsMisspellings) {
  const std::vector<std::string> names{"maxleaf", "splitmethod", "x", "maxdepth"};
  EXPECT_EQ(nearest("maxleafs", names), "maxleaf");
  EXPECT_EQ(nearest("MaxDepth", names), "maxdepth");
  EXPECT_EQ(nearest("splitmetod", names), "splitmethod");
  EXPECT_EQ(nearest("mxadepht", names), "maxdepth");
  EXPECT_EQ(nearest("maxdepth", names), "maxdepth");
  EXPECT_EQ(nearest("integrator", names), "");
  EXPECT_EQ(nearest("", names), "");
  // One letter would have to be replaced as a whole.
  EXPECT_EQ(nearest("y", names), "");
  EXPECT_EQ(nearest("abc", {}), "");
  EXPECT_EQ(didYouMean("maxleafs", names), "; did you mean \"maxleaf\"?");
  EXPECT_EQ(didYouMean("integrator", names), "");
  // Bytes above 127 are letters, not trouble.
  EXPECT_EQ(nearest("gr\xc3\xb6\xc3\x9f"
                    "e",
                    std::vector<std::string>{"gr\xc3\xb6sse"}),
            "gr\xc3\xb6sse");
}

TEST(Diagnostics, EqualWarningsOnce) {
  const SourceFiles files;
  std::vector<std::string> heard;
  Diagnostics d(files, [&](const std::string& t) { heard.push_back(t); });
  d.warn({}, "a");
  d.warn({}, "a");
  d.warn({}, "b");
  EXPECT_EQ(heard, (std::vector<std::string>{"warning: a", "warning: b"}));
  EXPECT_EQ(d.warnings(), 2u);
}

TEST(Diagnostics, ManyThreads) {
  const SourceFiles files;
  int heard = 0;
  Diagnostics d(files, [&](const std::string&) { ++heard; });
  {
    std::vector<std::jthread> threads;
    for (int t = 0; t < 4; ++t)
      threads.emplace_back([&d] {
        for (int i = 0; i < 200; ++i) d.warn({}, std::to_string(i));
      });
  }
  EXPECT_EQ(heard, 200);
}

}  // namespace
}  // namespace lampyris
