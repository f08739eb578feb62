// SPDX-License-Identifier: Apache-2.0
// Renders that cannot write where they should, are told to end, or share a file.
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <thread>

#include "core/image.h"
#include "tools/command_test_support.h"

namespace lampyris::test {

namespace {

namespace fs = std::filesystem;

class NothingIsLost : public CommandTest {
 protected:
  /// The one file whose name begins so; "" if there is none.
  std::string fileLike(const std::string& beginning) const {
    for (const auto& entry : fs::directory_iterator(path("")))
      if (entry.path().filename().string().starts_with(beginning)) return entry.path().filename();
    return "";
  }
  /// A render of very many samples in the background.
  pid_t start(std::vector<const char*> arguments) const {
    const pid_t child = fork();
    if (child != 0) return child;
    if (chdir(path("").c_str()) != 0) _exit(99);
    if (!std::freopen("stderr.txt", "w", stderr)) _exit(99);
    arguments.insert(arguments.begin(), {"lampyris", "--spp", "1000000000"});
    arguments.insert(arguments.end(), {"tiny.pbrt", nullptr});
    execv(LAMPYRIS_BINARY, const_cast<char* const*>(arguments.data()));
    _exit(99);
  }
  void waitFor(const std::string& name) const {
    for (int i = 0; i < 3000 && !exists(name); ++i)
      std::this_thread::sleep_for(std::chrono::milliseconds(5));
    ASSERT_TRUE(exists(name)) << name;
  }
  static int endOf(pid_t child, int signal) {
    kill(child, signal);
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }
};

constexpr const char* kNoFile4k = "ulimit -f 4";  // in pieces of 512 bytes; the image is larger

TEST_F(NothingIsLost, AFullDiskIsAnErrorThatSaysSo) {
  ASSERT_EQ(run("--quiet -o old.pfm tiny.pbrt").code, 0);
  const std::string old = read("old.pfm");
  const CommandResult r = run("--quiet --seed 2 -o old.pfm tiny.pbrt",
                              std::string("export TMPDIR=$PWD && ") + kNoFile4k);
  EXPECT_EQ(r.code, 3) << r.err;
  EXPECT_NE(r.err.find("cannot write \"old.pfm\": File too large"), std::string::npos) << r.err;
  EXPECT_NE(r.err.find("nor could it be saved"), std::string::npos) << r.err;
  EXPECT_EQ(read("old.pfm"), old);
  EXPECT_EQ(fileLike("old.pfm."), "");
}

TEST_F(NothingIsLost, CheckpointsThatCannotBeWrittenDoNotEndTheRender) {
  // Sums take more room than the compressed image.
  const CommandResult r =
      run("--checkpoint c --checkpoint-interval 0 -o a.png tiny.pbrt", "ulimit -f 12");
  EXPECT_EQ(r.code, 3) << r.err;
  EXPECT_NE(r.err.find("\"c\": File too large; the render goes on"), std::string::npos) << r.err;
  EXPECT_EQ(readImageFile(path("a.png").string()).image.width(), 24);
  EXPECT_FALSE(exists("c"));
}

TEST_F(NothingIsLost, AVanishedFolderLeavesTheImageElsewhere) {
  ASSERT_EQ(run("--spp 1 --quiet -o whole.pfm tiny.pbrt").code, 0);
  fs::create_directory(path("out"));
  const pid_t child =
      start({"--quiet", "-o", "out/a.exr", "--checkpoint", "c", "--checkpoint-interval", "0"});
  waitFor("c");
  fs::remove_all(path("out"));
  EXPECT_EQ(endOf(child, SIGTERM), 3);
  const std::string error = read("stderr.txt");
  EXPECT_NE(error.find("cannot write \"out/a.exr\": No such file or directory"), std::string::npos)
      << error;
  const std::string rescued = fileLike("a-rescued-");
  ASSERT_NE(rescued, "") << error;
  EXPECT_NE(error.find(rescued), std::string::npos) << error;
  EXPECT_EQ(readImageFile(path(rescued).string()).image.width(), 24);
}

TEST_F(NothingIsLost, FoldersThatTakeNoFilesAreToldOfBeforeTheRender) {
  // A folder where not even root can make a file.
  const CommandResult r = run("--spp 1000000000 -o /proc/a.exr tiny.pbrt");
  EXPECT_EQ(r.code, 3);
  EXPECT_NE(r.err.find("cannot write \"/proc/a.exr\""), std::string::npos) << r.err;
}

TEST_F(NothingIsLost, SignalsLeaveAnImageThatTellsItsSamples) {
  for (const int signal : {SIGINT, SIGTERM}) {
    fs::remove(path("c"));
    const pid_t child =
        start({"--quiet", "-o", "part.exr", "--checkpoint", "c", "--checkpoint-interval", "0"});
    waitFor("c");
    EXPECT_EQ(endOf(child, signal), 130);
    const std::string file = read("part.exr");
    const std::string key = std::string("samplesPerPixel") + '\0' + "string" + '\0';
    const size_t at = file.find(key);
    ASSERT_NE(at, std::string::npos);
    EXPECT_GE(std::atof(file.c_str() + at + key.size() + sizeof(int32_t)), 1);
    const Image image = readImageFile(path("part.exr").string()).image;
    for (const float v : image.data()) EXPECT_TRUE(v >= 0 && v < 10) << v;
  }
}

TEST_F(NothingIsLost, NobodyNeedsToListen) {
  ASSERT_EQ(run("-o heard.pfm tiny.pbrt").code, 0);
  const std::string render = "('" LAMPYRIS_BINARY "' -o unheard.pfm tiny.pbrt; echo $? >code)";
  for (const std::string end : {" 2>/dev/full", " 2>&-", " 2>&1 | true"}) {
    fs::remove(path("unheard.pfm"));
    run("--help", "(" + render + end + ")");
    EXPECT_EQ(read("code"), "0\n") << end;
    EXPECT_EQ(read("unheard.pfm"), read("heard.pfm")) << end;
  }
}

TEST_F(NothingIsLost, RendersThatShareAFileLeaveOneOfTheirImages) {
  ASSERT_EQ(run("--seed 1 -o one.pfm tiny.pbrt").code, 0);
  ASSERT_EQ(run("--seed 2 -o two.pfm tiny.pbrt").code, 0);
  const auto both = [](const std::string& rest) {
    std::string command;
    for (const char* seed : {"1", "2"})
      command += std::string("'" LAMPYRIS_BINARY "' --quiet --seed ") + seed + rest + " & ";
    return "(" + command + "wait)";
  };
  for (int i = 0; i < 5; ++i) {
    run("--help", both(" -o same.pfm --checkpoint c --checkpoint-interval 0 tiny.pbrt"));
    const std::string same = read("same.pfm");
    EXPECT_TRUE(same == read("one.pfm") || same == read("two.pfm"));
    // The checkpoint is one of theirs, too: whole, and fit for one of the seeds.
    const int one = run("--seed 1 --resume c tiny.pbrt").code;
    const int two = run("--seed 2 --resume c tiny.pbrt").code;
    EXPECT_EQ(one + two, 3) << one << two;
  }
}

}  // namespace

}  // namespace lampyris::test
