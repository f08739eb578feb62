// SPDX-License-Identifier: Apache-2.0
/// Runs the built program as a person would.
#pragma once

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace lampyris::test {

struct CommandResult {
  int code = -1;
  std::string out, err;
};

inline std::string readText(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

/// A folder of its own for each test, removed afterwards, that commands run in.
class CommandTest : public ::testing::Test {
 protected:
  void SetUp() override {
    const auto* info = ::testing::UnitTest::GetInstance()->current_test_info();
    folder_ = std::filesystem::temp_directory_path() /
              ("lampyris-" + std::string(info->name()) + "-" + std::to_string(getpid()));
    std::filesystem::create_directories(folder_);
    write("tiny.pbrt", scene());
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  void write(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name, std::ios::binary) << text;
  }
  std::filesystem::path path(const std::string& name) const { return folder_ / name; }
  std::string read(const std::string& name) const { return readText(folder_ / name); }
  bool exists(const std::string& name) const { return std::filesystem::exists(folder_ / name); }

  /// `arguments` as the shell reads them, after the commands of `setUp`.
  CommandResult run(const std::string& arguments, const std::string& setUp = ":") const {
    const std::string command = "cd '" + folder_.string() + "' && " + setUp +
                                " && '" LAMPYRIS_BINARY "' " + arguments +
                                " >stdout.txt 2>stderr.txt";
    const int status = std::system(command.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, read("stdout.txt"), read("stderr.txt")};
  }

  static std::string scene(const std::string& integrator = "\"path\"") {
    return "Integrator " + integrator +
           "\nSampler \"random\" \"integer pixelsamples\" 4\nPixelFilter \"box\"\n"
           "Film \"image\" \"integer xresolution\" 24 \"integer yresolution\" 16 "
           "\"string filename\" \"tiny.exr\"\n"
           "LookAt 0 -3 1  0 0 0  0 0 1\nCamera \"perspective\" \"float fov\" 45\n"
           "WorldBegin\nLightSource \"infinite\" \"rgb L\" [0.5 0.6 0.7]\n"
           "LightSource \"point\" \"point from\" [1 -1 2]\n"
           "Material \"matte\" \"rgb Kd\" [0.6 0.5 0.4]\n"
           "Shape \"sphere\" \"float radius\" 0.7\nWorldEnd\n";
  }

 private:
  std::filesystem::path folder_;
};

}  // namespace lampyris::test
