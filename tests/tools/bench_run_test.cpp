// SPDX-License-Identifier: Apache-2.0
#include "tools/command_test_support.h"

namespace lampyris::test {

namespace {

/// The names of all micro-benchmarks.
std::vector<std::string> programs() {
  std::vector<std::string> names;
  for (const auto& file : std::filesystem::directory_iterator(LAMPYRIS_SOURCE_DIR "/bench"))
    if (file.path().extension() == ".cpp" && file.path().stem().string().starts_with("bench_"))
      names.push_back(file.path().stem().string());
  return names;
}

/// Runs bench/run with programs that print made-up times.
class BenchRun : public CommandTest {
 protected:
  void SetUp() override {
    CommandTest::SetUp();
    if (std::system("python3 --version >/dev/null 2>&1") != 0) GTEST_SKIP() << "no python3";
    std::filesystem::create_directories(path("build/bench"));
    for (const std::string& name : programs()) program(name, 100);
    script("ray_replay",
           "echo 'render 10 paths/s, replay 20 paths/s (3 hits), render/replay 2.00'");
  }

  void script(const std::string& name, const std::string& text) const {
    const std::string file = "build/bench/" + name;
    write(file, "#!/bin/sh\n" + text + "\n");
    std::filesystem::permissions(path(file), std::filesystem::perms::owner_all);
  }
  void program(const std::string& name, double nanoseconds) const {
    const std::string time = std::to_string(nanoseconds);
    script(name, R"(case "$*" in *list_tests*) echo work/1; exit ;; esac
echo '{"benchmarks": [{"name": "work/1", "real_time": 1, "cpu_time": )" +
                     time + R"(, "time_unit": "ns"}]}')");
  }
  CommandResult bench(const std::string& arguments) const {
    const std::string command = "cd '" + path("").string() +
                                "' && '" LAMPYRIS_SOURCE_DIR
                                "/bench/run' --no-build --build build --baseline base.json " +
                                arguments + " >stdout.txt 2>stderr.txt";
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read("stdout.txt"), read("stderr.txt")};
  }
};

TEST_F(BenchRun, ComparesWithTheBaseline) {
  EXPECT_EQ(bench("").code, 3);  // there is no baseline yet
  const CommandResult update = bench("--update");
  EXPECT_EQ(update.code, 0) << update.err;
  EXPECT_NE(read("base.json").find("\"bench_rays:work/1\": 1.0"), std::string::npos)
      << read("base.json");
  const CommandResult same = bench("");
  EXPECT_EQ(same.code, 0) << same.err;
  // All but the calibration, and the replay.
  const std::string none = "0 of " + std::to_string(programs().size()) + " slower";
  EXPECT_NE(same.out.find(none), std::string::npos) << same.out;

  program("bench_rays", 160);
  const CommandResult slower = bench("");
  EXPECT_EQ(slower.code, 1);
  EXPECT_NE(slower.out.find("1.60  slower"), std::string::npos) << slower.out;
  EXPECT_EQ(bench("--tolerance 1.7").code, 0);
  EXPECT_EQ(bench("--filter samplers").code, 0);
  // What is not wanted doesn't run.
  script("bench_shapes", "case \"$*\" in *list_tests*) echo work/1 ;; *) exit 7 ;; esac");
  EXPECT_EQ(bench("--filter samplers").code, 0);
  EXPECT_EQ(bench("").code, 3);
  program("bench_shapes", 100);
  // A machine on which everything is slower alike is no regression.
  for (const std::string& name : programs()) program(name, 160);
  EXPECT_EQ(bench("").code, 0);
  script("ray_replay", "echo 'render/replay 4.00'");
  EXPECT_EQ(bench("").code, 1);
}

TEST_F(BenchRun, Errors) {
  EXPECT_EQ(bench("--update").code, 0);
  EXPECT_EQ(bench("--tolerance 0.5").code, 2);
  EXPECT_EQ(bench("--min-time 0").code, 2);
  EXPECT_EQ(bench("--filter '('").code, 2);
  EXPECT_EQ(bench("--update --filter x").code, 2);
  EXPECT_EQ(bench("--nonsense").code, 2);
  EXPECT_EQ(bench("--filter nothing").code, 3);
  write("base.json", "{}");
  EXPECT_EQ(bench("").code, 3);
  EXPECT_EQ(bench("--update").code, 0);
  script("bench_rays", "echo broken >&2; exit 7");
  const CommandResult broken = bench("");
  EXPECT_EQ(broken.code, 3);
  EXPECT_NE(broken.err.find("bench_rays"), std::string::npos) << broken.err;
  std::filesystem::remove(path("build/bench/bench_rays"));
  EXPECT_EQ(bench("").code, 3);
}

}  // namespace

}  // namespace lampyris::test
