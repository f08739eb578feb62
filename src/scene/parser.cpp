// SPDX-License-Identifier: Apache-2.0
#include "scene/parser.h"

#include <fmt/format.h>

#include <filesystem>

#include "scene/world_parser.h"

namespace lampyris {

std::string resolveScenePath(const std::string& folder, std::string_view name) {
  const std::filesystem::path path(name);
  if (path.is_absolute() || folder.empty() || name.empty()) return std::string(name);
  return (std::filesystem::path(folder) / path).lexically_normal().string();
}

Description parseScene(uint16_t mainFile, const std::string& folder, SourceFiles& files,
                       Diagnostics& diagnostics) {
  Description description;
  WorldParser(description, folder, files, diagnostics).run(mainFile);
  return description;
}

}  // namespace lampyris
