// SPDX-License-Identifier: Apache-2.0
#include "core/atomic_file.h"

#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>

#include "core/image_test_files.h"

namespace lampyris {
namespace {

using namespace test;

TEST(AtomicFile, AppearsOnCommitOnly) {
  const TemporaryFolder folder;
  {
    AtomicFile file(folder / "a");
    file.write("new", 3);
    EXPECT_FALSE(std::filesystem::exists(folder / "a"));
    file.commit();
  }
  EXPECT_EQ(readBytes(folder / "a"), "new");
  { AtomicFile(folder / "a").write("lost", 4); }
  EXPECT_EQ(readBytes(folder / "a"), "new");
  std::filesystem::create_symlink("a", folder / "link");
  AtomicFile file(folder / "link");
  file.write("12345", 5);
  file.seek(1);
  file.write("x", 1);
  EXPECT_EQ(file.tell(), 2u);
  file.commit();
  EXPECT_EQ(readBytes(folder / "a"), "1x345");
  EXPECT_TRUE(std::filesystem::is_symlink(folder / "link"));
  EXPECT_EQ(folder.fileCount(), 2u);
}

TEST(AtomicFile, TakesOverWhatAKilledWriterHasLeft) {
  const TemporaryFolder folder;
  for (int kills = 0; kills < 3; ++kills) {
    const pid_t child = fork();
    if (child == 0) {
      AtomicFile file(folder / "a");
      const std::string text(100'000, 'x');
      file.write(text.data(), text.size());
      raise(SIGKILL);
    }
    waitpid(child, nullptr, 0);
    EXPECT_EQ(folder.fileCount(), 1u);
  }
  AtomicFile file(folder / "a");
  file.write("short", 5);
  file.commit();
  EXPECT_EQ(readBytes(folder / "a"), "short");
  EXPECT_EQ(folder.fileCount(), 1u);
}

/// Processes write, are killed, and let others take over, all at once: the file is always whole.
TEST(AtomicFile, WritersDoNotMix) {
  const TemporaryFolder folder;
  constexpr size_t kSize = 20'000;
  std::vector<pid_t> children;
  for (const char letter : {'a', 'b', 'c', 'd', 'e', 'f'}) {
    children.push_back(fork());
    if (children.back() != 0) continue;
    const std::string text(kSize, letter);
    for (int round = 0; round < 40; ++round) {
      AtomicFile file(folder / "out");
      file.write(text.data(), kSize / 2);
      file.write(text.data(), kSize - kSize / 2);
      if (letter == 'a' && round == 20) raise(SIGKILL);
      if (round % 3 > 0) file.commit();
    }
    _exit(0);
  }
  int running = static_cast<int>(children.size()), mixed = 0, reads = 0;
  while (running > 0) {
    int status = 0;
    if (waitpid(-1, &status, WNOHANG) > 0) {
      --running;
      EXPECT_TRUE(WIFSIGNALED(status) || WEXITSTATUS(status) == 0) << status;
    }
    if (!std::filesystem::exists(folder / "out")) continue;
    const std::string text = readBytes(folder / "out");
    ++reads;
    mixed += text != std::string(kSize, text[0]);
  }
  EXPECT_GT(reads, 0);
  EXPECT_EQ(mixed, 0);
  // The killed one's stays until as many write at once again.
  EXPECT_LE(folder.fileCount(), 2u);
}

}  // namespace
}  // namespace lampyris
