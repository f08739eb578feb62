// SPDX-License-Identifier: Apache-2.0
/// Reads small scenes and says what came of them.
#pragma once

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "scene/builder.h"
#include "scene/parser.h"

namespace lampyris::test {

inline constexpr const char* kTriangle =
    "Shape \"trianglemesh\" \"integer indices\" [0 1 2] \"point P\" [0 0 0 1 0 0 0 1 0] ";

/// A tiny film, the given world.
inline std::string world(const std::string& content) {
  return "Film \"image\" \"integer xresolution\" 8 \"integer yresolution\" 4\nWorldBegin\n" +
         content + "\nWorldEnd\n";
}

/// What reading a scene needs, and the warnings it gave: "line:column: message".
struct Reader {
  SourceFiles files;
  std::vector<std::string> warnings;
  Diagnostics diagnostics{files,
                          [this](const std::string& text) { warnings.push_back(firstLine(text)); }};
  Statistics statistics;

  Description parse(const std::string& text, const std::string& folder = "") {
    return parseScene(files.add("s", text), folder, files, diagnostics);
  }
  std::unique_ptr<RenderJob> build(const std::string& text, const BuildOptions& options = {},
                                   const std::string& folder = "") {
    return loadSceneText(text, folder, options, files, diagnostics, statistics);
  }
  /// "line:column: message", without the place where there is none.
  std::string describe(const SceneError& e) const {
    const auto at = files.position(e.location);
    return at.line ? fmt::format("{}:{}: {}", at.line, at.column, e.what()) : e.what();
  }

 private:
  static std::string firstLine(const std::string& text) { return text.substr(0, text.find('\n')); }
};

/// The error of reading the text; "" if there is none.
inline std::string parseError(const std::string& text, const std::string& folder = "") {
  Reader r;
  try {
    r.parse(text, folder);
  } catch (const SceneError& e) {
    return r.describe(e);
  }
  return "";
}
inline std::string buildError(const std::string& text, const BuildOptions& options = {},
                              const std::string& folder = "") {
  Reader r;
  try {
    r.build(text, options, folder);
  } catch (const SceneError& e) {
    return r.describe(e);
  }
  return "";
}

/// A directory that lives as long as this object.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string name = (std::filesystem::temp_directory_path() / "scene-XXXXXX").string();
    if (!mkdtemp(name.data())) throw std::runtime_error("no temporary folder");
    path_ = name;
  }
  ~TemporaryFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::string& path() const { return path_; }
  std::string write(const std::string& name, const std::string& text) const {
    const std::filesystem::path file = std::filesystem::path(path_) / name;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file, std::ios::binary) << text;
    return file.string();
  }

 private:
  std::string path_;
};

}  // namespace lampyris::test
