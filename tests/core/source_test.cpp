// SPDX-License-Identifier: Apache-2.0
#include "core/source.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <filesystem>
#include <fstream>

#include "core/error.h"

namespace lampyris {
namespace {

class SourceTest : public testing::Test {
 protected:
  void SetUp() override {
    const auto* info = testing::UnitTest::GetInstance()->current_test_info();
    folder_ = testing::TempDir() + "lampyris_source_" + info->name();
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::string file(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ + "/" + name, std::ios::binary) << text;
    return folder_ + "/" + name;
  }
  std::string folder_;
};

TEST_F(SourceTest, Positions) {
  SourceFiles files;
  const uint16_t f = files.add("x", "ab\n\ncd\n");
  const auto expectAt = [&](uint32_t offset, int line, int column, std::string_view text) {
    const auto p = files.position({f, offset});
    EXPECT_EQ(p.file, "x");
    EXPECT_EQ(p.line, line) << offset;
    EXPECT_EQ(p.column, column) << offset;
    EXPECT_EQ(p.lineText, text) << offset;
  };
  expectAt(0, 1, 1, "ab");
  expectAt(1, 1, 2, "ab");
  expectAt(2, 1, 3, "ab");
  expectAt(3, 2, 1, "");
  expectAt(4, 3, 1, "cd");
  expectAt(7, 4, 1, "");
  expectAt(1000, 4, 1, "");
  EXPECT_EQ(files.position({}).line, 0);
  EXPECT_EQ(files.position({9, 0}).line, 0);
  EXPECT_FALSE(SourceLocation{}.known());
  EXPECT_TRUE((SourceLocation{f, 0}.known()));
}

TEST_F(SourceTest, MapsFiles) {
  const std::string path = file("a", "Shape \"sphere\"\n");
  SourceFiles files;
  const uint16_t f = files.open(path), g = files.open(file("empty", ""));
  EXPECT_EQ(files.text(f), "Shape \"sphere\"\n");
  EXPECT_EQ(files.name(f), path);
  EXPECT_EQ(files.text(g), "");
  EXPECT_EQ(files.position({g, 0}).line, 1);
}

TEST_F(SourceTest, ViewsStayValid) {
  SourceFiles files;
  const std::string_view first = files.text(files.add("s", "short"));
  for (int i = 0; i < 1000; ++i) files.add("more", std::string(static_cast<size_t>(i), 'x'));
  EXPECT_EQ(first, "short");
  EXPECT_EQ(first.data(), files.text(0).data());
}

TEST_F(SourceTest, UnreadableFilesAreErrorsAndLeaveNoTrace) {
  SourceFiles files;
  EXPECT_THROW(files.open(folder_ + "/missing"), IoError);
  EXPECT_THROW(files.open(folder_), IoError);
  const std::string pipe = folder_ + "/pipe";
  ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
  EXPECT_THROW(files.open(pipe), IoError);  // and doesn't wait for a writer
  EXPECT_EQ(files.add("first", ""), 0);
}

TEST_F(SourceTest, TooManyFilesAreAnError) {
  SourceFiles files;
  for (int i = 0; i < 0xffff; ++i) files.add("", "");
  EXPECT_THROW(files.add("", ""), IoError);
  EXPECT_THROW(files.open(file("a", "x")), IoError);
  EXPECT_TRUE((SourceLocation{0xfffe, 0}.known()));
  EXPECT_EQ(files.position({0xfffe, 0}).line, 1);
}

TEST_F(SourceTest, MappingsMove) {
  MappedFile a(file("a", "aaa")), b(file("b", "bb"));
  MappedFile c(std::move(a));
  EXPECT_EQ(c.text(), "aaa");
  c = std::move(b);
  EXPECT_EQ(c.text(), "bb");
  EXPECT_EQ(MappedFile().text(), "");
}

}  // namespace
}  // namespace lampyris
