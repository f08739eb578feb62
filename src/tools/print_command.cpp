// SPDX-License-Identifier: Apache-2.0
#include "tools/print_command.h"

#include <fmt/format.h>

#include <cstdio>
#include <filesystem>
#include <iostream>
#include <iterator>

#include "tools/with_scene.h"

namespace lampyris {

namespace {

void toStandardOutput(std::string_view text) {
  if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size())
    throw IoError("cannot write to standard output");
}

}  // namespace

int runPrint(const RenderSettings& settings) {
  const std::string& scene = settings.scenes.front();
  return withScene(settings.quiet, [&](SourceFiles& files, Diagnostics& diagnostics) {
    const bool isFile = scene != "-";
    const uint16_t file =
        isFile ? files.open(scene)
               : files.add("<standard input>",
                           std::string(std::istreambuf_iterator<char>(std::cin), {}));
    const std::string folder = isFile ? std::filesystem::path(scene).parent_path().string() : ".";
    printScene(file, folder, *settings.print, files, diagnostics, toStandardOutput);
    if (std::fflush(stdout) != 0) throw IoError("cannot write to standard output");
  });
}

}  // namespace lampyris
