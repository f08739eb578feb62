// SPDX-License-Identifier: Apache-2.0
#include "core/control_group.h"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

namespace lampyris::test {
namespace {

namespace fs = std::filesystem;

/// A folder that looks like / to what reads control groups.
class ControlGroup : public testing::Test {
 protected:
  ControlGroup() {
    // Tests may run at the same time.
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    root_ = testing::TempDir() + "lampyris_control_group_" + test->name();
    fs::remove_all(root_);
  }
  ~ControlGroup() override { fs::remove_all(root_); }

  void write(const std::string& name, const std::string& text) const {
    const fs::path file = root_ + "/" + name;
    fs::create_directories(file.parent_path());
    std::ofstream(file) << text << '\n';
  }
  void second(const std::string& group, const std::string& limit, const std::string& used) const {
    write("sys/fs/cgroup" + group + "/memory.max", limit);
    write("sys/fs/cgroup" + group + "/memory.current", used);
  }
  void first(const std::string& group, const std::string& limit, const std::string& used) const {
    write("sys/fs/cgroup/memory" + group + "/memory.limit_in_bytes", limit);
    write("sys/fs/cgroup/memory" + group + "/memory.usage_in_bytes", used);
  }
  double left() const { return leftByControlGroup(root_); }

 private:
  std::string root_;
};

TEST_F(ControlGroup, NoneLeavesAll) {
  EXPECT_TRUE(std::isinf(left()));
  write("proc/self/cgroup", "0::/");
  EXPECT_TRUE(std::isinf(left()));
  second("", "max", "1000");
  EXPECT_TRUE(std::isinf(left()));
}

TEST_F(ControlGroup, TheTightestOfTheSecondVersionCounts) {
  write("proc/self/cgroup", "0::/jobs/one");
  second("/jobs/one", "max", "400");
  second("/jobs", "3000", "1000");
  EXPECT_EQ(left(), 2000);
  second("/jobs/one", "1500", "400");
  EXPECT_EQ(left(), 1100);
  second("/jobs/one", "1500", "1600");
  EXPECT_EQ(left(), 0);
}

TEST_F(ControlGroup, TheFirstVersionCounts) {
  write("proc/self/cgroup", "7:cpu,cpuacct:/a\n4:memory:/a/b\n1:name=memory:/c\n0::/");
  first("/c", "1", "1");
  first("/a/b", "9223372036854771712", "500");
  EXPECT_GT(left(), 9e18);
  first("/a", "9000", "500");
  EXPECT_EQ(left(), 8500);
  write("proc/self/cgroup", "4:hugetlb,memory:/a/b");
  EXPECT_EQ(left(), 8500);
}

TEST_F(ControlGroup, InsideAContainerTheFolderIsTheGroup) {
  write("proc/self/cgroup", "4:memory:/docker/0123");
  first("", "5000", "1000");
  EXPECT_EQ(left(), 4000);
  write("proc/self/cgroup", "0::/../elsewhere");
  second("", "700", "100");
  EXPECT_EQ(left(), 600);
}

TEST_F(ControlGroup, FilesInMemoryCanBeHad) {
  write("proc/self/cgroup", "0::/jobs");
  second("/jobs", "5000", "4900");
  write("sys/fs/cgroup/jobs/memory.stat", "anon 1000\nfile 3900\ninactive_file 3500\n");
  EXPECT_EQ(left(), 3600);
  write("proc/self/cgroup", "4:memory:/jobs");
  first("/jobs", "5000", "4900");
  write("sys/fs/cgroup/memory/jobs/memory.stat", "inactive_file 1\ntotal_inactive_file 2000\n");
  EXPECT_EQ(left(), 2100);
}

}  // namespace
}  // namespace lampyris::test
