// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <thread>

#include "core/image.h"
#include "tools/command_test_support.h"

namespace lampyris::test {

namespace {

using Render = CommandTest;

TEST_F(Render, WritesTheFilmsFileAndAPng) {
  const CommandResult r = run("tiny.pbrt");
  EXPECT_EQ(r.code, 0) << r.err;
  EXPECT_TRUE(exists("tiny.exr"));
  EXPECT_TRUE(exists("tiny.png"));
  EXPECT_NE(r.err.find("4 spp"), std::string::npos) << r.err;
  EXPECT_EQ(readLinearImage(path("tiny.exr").string()).width(), 24);
}

TEST_F(Render, QuietSaysNothing) {
  const CommandResult r = run("--quiet tiny.pbrt");
  EXPECT_EQ(r.code, 0);
  EXPECT_EQ(r.out + r.err, "");
}

TEST_F(Render, SeveralOutputs) {
  EXPECT_EQ(run("--out a.exr --outfile b.png -o c.pfm tiny.pbrt").code, 0);
  EXPECT_TRUE(exists("a.exr") && exists("b.png") && exists("c.pfm"));
  EXPECT_FALSE(exists("tiny.exr"));
}

TEST_F(Render, ReadsStandardInput) {
  EXPECT_EQ(run("--out piped.pfm - <tiny.pbrt").code, 0);
  EXPECT_EQ(run("--out direct.pfm tiny.pbrt").code, 0);
  EXPECT_EQ(read("piped.pfm"), read("direct.pfm"));
}

TEST_F(Render, ThreadsChangeNothingAndSeedsDo) {
  EXPECT_EQ(run("--threads 1 -o a.pfm tiny.pbrt").code, 0);
  EXPECT_EQ(run("--nthreads=3 -o b.pfm tiny.pbrt").code, 0);
  EXPECT_EQ(run("--seed 5 -o c.pfm tiny.pbrt").code, 0);
  EXPECT_EQ(read("a.pfm"), read("b.pfm"));
  EXPECT_NE(read("a.pfm"), read("c.pfm"));
}

TEST_F(Render, OverridesAndSampleCounts) {
  EXPECT_EQ(run("-D integrator.maxdepth=0 --stats s.json -o a.pfm tiny.pbrt").code, 0);
  EXPECT_NE(read("s.json").find("\"samples per pixel\": 4"), std::string::npos) << read("s.json");
  EXPECT_NE(read("s.json").find("\"shadow rays\": 0"), std::string::npos) << read("s.json");
  EXPECT_EQ(run("--spp 7 --stats s.json -o a.pfm tiny.pbrt").code, 0);
  EXPECT_NE(read("s.json").find("\"samples per pixel\": 7"), std::string::npos);
  EXPECT_EQ(run("--seconds 0.05 --stats s.json -o a.pfm tiny.pbrt").code, 0);
  const CommandResult unknown = run("-D integrator.maxdept=0 tiny.pbrt");
  EXPECT_EQ(unknown.code, 1);
  EXPECT_NE(unknown.err.find("maxdepth"), std::string::npos) << unknown.err;
  EXPECT_EQ(run("-D nonsense tiny.pbrt").code, 2);
}

TEST_F(Render, CropInEverySpelling) {
  for (const char* crop : {"--crop 0 0.5 0.25 0.75", "--crop 0,0.5,0.25,0.75",
                           "--cropwindow=0,0.5,0.25,0.75", "-cropwindow 0 0.5 0.25 0.75"}) {
    const CommandResult r = run("-o crop.pfm " + std::string(crop) + " tiny.pbrt");
    EXPECT_EQ(r.code, 0) << crop << r.err;
    const Image image = readLinearImage(path("crop.pfm").string());
    EXPECT_EQ(image.width(), 12) << crop;
    EXPECT_EQ(image.height(), 8) << crop;
  }
  EXPECT_EQ(run("--crop 0.5 0 0 1 tiny.pbrt").code, 2);
}

TEST_F(Render, QuickIsAQuarterOfTheSizeWithOneSample) {
  EXPECT_EQ(run("--quick --stats s.json -o quick.pfm tiny.pbrt").code, 0);
  EXPECT_EQ(readLinearImage(path("quick.pfm").string()).width(), 6);
  EXPECT_NE(read("s.json").find("\"samples per pixel\": 1"), std::string::npos);
}

TEST_F(Render, PixelPrintsWhatTheImageHolds) {
  EXPECT_EQ(run("-o a.pfm tiny.pbrt").code, 0);
  const CommandResult r = run("--pixel 12,8 --verbose tiny.pbrt");
  EXPECT_EQ(r.code, 0) << r.err;
  float red = -1;
  const size_t at = r.out.find("pixel 12,8: ");
  ASSERT_NE(at, std::string::npos) << r.out;
  ASSERT_EQ(std::sscanf(r.out.c_str() + at, "pixel 12,8: %f", &red), 1);
  EXPECT_FLOAT_EQ(red, readLinearImage(path("a.pfm").string()).at(12, 8, 0));
  EXPECT_NE(r.out.find("sample 3:"), std::string::npos);
  EXPECT_EQ(run("--pixel 24,0 tiny.pbrt").code, 2);
  EXPECT_EQ(run("--pixel 1 tiny.pbrt").code, 2);
}

TEST_F(Render, ExitCodes) {
  write("broken.pbrt", "WorldBegin\nShape \"spher\"\nWorldEnd\n");
  const CommandResult broken = run("broken.pbrt");
  EXPECT_EQ(broken.code, 1);
  EXPECT_NE(broken.err.find("broken.pbrt:2:"), std::string::npos) << broken.err;
  EXPECT_NE(broken.err.find("sphere"), std::string::npos) << broken.err;

  const CommandResult option = run("--sppp 3 tiny.pbrt");
  EXPECT_EQ(option.code, 2);
  EXPECT_NE(option.err.find("did you mean \"--spp\""), std::string::npos) << option.err;
  EXPECT_EQ(run("").code, 2);
  EXPECT_EQ(run("--spp 0 tiny.pbrt").code, 2);
  EXPECT_EQ(run("--spp many tiny.pbrt").code, 2);
  EXPECT_EQ(run("--cat -o a.exr tiny.pbrt").code, 2);
  EXPECT_EQ(run("-o a.xyz tiny.pbrt").code, 2);
  EXPECT_EQ(run("--help").code, 0);
  EXPECT_EQ(run("help").out, run("--help").out);

  EXPECT_EQ(run("missing.pbrt").code, 3);
  const CommandResult folder = run("-o missing/a.exr tiny.pbrt");
  EXPECT_EQ(folder.code, 3);
  EXPECT_NE(folder.err.find("missing"), std::string::npos);
  EXPECT_EQ(run("--resume missing.checkpoint tiny.pbrt").code, 3);
}

TEST_F(Render, WhatIntegratorsCannotDoIsRefused) {
  write("mlt.pbrt", scene("\"mlt\" \"integer bootstrapsamples\" 100"));
  EXPECT_EQ(run("--spp 2 -o mlt.exr mlt.pbrt").code, 0);
  for (const char* option :
       {"--pixel 3,3", "--noise 0.1", "--aov normal", "--checkpoint c", "--resume c"}) {
    const CommandResult r = run(std::string(option) + " mlt.pbrt");
    EXPECT_EQ(r.code, 2) << option;
    EXPECT_NE(r.err.find("cannot be used with it"), std::string::npos) << r.err;
  }
}

TEST_F(Render, SeveralScenesOneAfterAnother) {
  std::string other = scene();
  other.replace(other.find("tiny.exr"), 8, "othr.exr");
  write("other.pbrt", other);
  EXPECT_EQ(run("tiny.pbrt other.pbrt").code, 0);
  EXPECT_TRUE(exists("tiny.exr") && exists("othr.exr"));
  EXPECT_EQ(run("-o a.exr tiny.pbrt other.pbrt").code, 2);
}

TEST_F(Render, ResumeGivesTheSameBits) {
  EXPECT_EQ(run("--spp 12 -o whole.pfm tiny.pbrt").code, 0);
  EXPECT_EQ(run("--spp 5 -o part.pfm --checkpoint c tiny.pbrt").code, 0);
  EXPECT_EQ(run("--spp 12 -o resumed.pfm --resume c tiny.pbrt").code, 0);
  EXPECT_EQ(read("whole.pfm"), read("resumed.pfm"));
  EXPECT_NE(read("whole.pfm"), read("part.pfm"));
  for (const char* other : {"--seed 3", "-D integrator.maxdepth=2", "--crop 0 0.5 0 1"}) {
    const CommandResult r = run("--spp 12 --resume c " + std::string(other) + " tiny.pbrt");
    EXPECT_EQ(r.code, 3) << other;
    EXPECT_NE(r.err.find("another scene"), std::string::npos) << r.err;
  }
  std::string bytes = read("c");
  bytes[bytes.size() / 2] = static_cast<char>(bytes[bytes.size() / 2] ^ 1);
  write("damaged", bytes);
  EXPECT_EQ(run("--resume damaged tiny.pbrt").code, 3);
  write("short", bytes.substr(0, 30));
  EXPECT_EQ(run("--resume short tiny.pbrt").code, 3);
}

/// Starts a render of very many samples, waits for its checkpoint and sends a signal.
int interruptRender(const std::filesystem::path& folder, int signal,
                    const char* integrator = "integrator=path") {
  const pid_t child = fork();
  if (child == 0) {
    if (chdir(folder.c_str()) != 0) _exit(99);
    execl(LAMPYRIS_BINARY, "lampyris", "--quiet", "--spp", "1000000000", "--checkpoint", "c",
          "--checkpoint-interval", "0", "-D", integrator, "-o", "part.pfm", "tiny.pbrt", nullptr);
    _exit(99);
  }
  for (int i = 0; i < 3000 && !std::filesystem::exists(folder / "c"); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  kill(child, signal);
  int status = 0;
  waitpid(child, &status, 0);
  return status;
}

TEST_F(Render, KilledRendersResumeToTheSameBits) {
  for (const std::string integrator : {"integrator=path", "integrator=guidedpath"}) {
    std::filesystem::remove(path("c"));
    const int status = interruptRender(path(""), SIGKILL, integrator.c_str());
    const std::string scene = "-D " + integrator + " tiny.pbrt";
    ASSERT_TRUE(WIFSIGNALED(status));
    ASSERT_TRUE(exists("c"));
    // A target below what the checkpoint holds renders nothing, but tells how much that is.
    EXPECT_EQ(run("--spp 1 --resume c --checkpoint c2 --stats s.json -o at.pfm " + scene).code, 0);
    const std::string stats = read("s.json");
    const std::string key = "\"samples per pixel\": ";
    const size_t at = stats.find(key);
    ASSERT_NE(at, std::string::npos) << stats;
    const int samples = std::atoi(stats.c_str() + at + key.size());
    ASSERT_GE(samples, 1);
    const std::string target = std::to_string(samples + 3);
    EXPECT_EQ(run("--spp " + target + " --resume c -o resumed.pfm " + scene).code, 0);
    EXPECT_EQ(run("--spp " + target + " -o whole.pfm " + scene).code, 0);
    EXPECT_EQ(read("whole.pfm"), read("resumed.pfm"));
  }
}

TEST_F(Render, InterruptedRendersWriteWhatThereIs) {
  const int status = interruptRender(path(""), SIGINT);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 130);
  EXPECT_TRUE(exists("part.pfm"));
  EXPECT_TRUE(exists("c"));
}

TEST_F(Render, WhileASceneIsLoadedTheFirstSignalEndsAll) {
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  const pid_t child = fork();
  if (child == 0) {
    dup2(ends[0], STDIN_FILENO);
    close(ends[1]);
    execl(LAMPYRIS_BINARY, "lampyris", "--quiet", "-", nullptr);
    _exit(99);
  }
  close(ends[0]);
  // More than a pipe holds: returns once the program reads.
  const std::string comments(1 << 18, '#');
  ASSERT_EQ(::write(ends[1], comments.data(), comments.size()), ssize_t{1} << 18);
  kill(child, SIGTERM);
  int status = 0;
  for (int i = 0; i < 2000 && waitpid(child, &status, WNOHANG) == 0; ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  close(ends[1]);
  EXPECT_TRUE(WIFSIGNALED(status)) << status;
  if (!WIFSIGNALED(status)) kill(child, SIGKILL);
}

}  // namespace

}  // namespace lampyris::test
