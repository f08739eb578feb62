// SPDX-License-Identifier: Apache-2.0
// A scene file, from its text to its description and back to a text.
#include "scene/scene_printer.h"
#include "target.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace lampyris;
  return fuzz::run<SceneError>(data, size, fuzz::kMebi + 4096 * size, [](std::string_view text) {
    SourceFiles files;
    Diagnostics diagnostics(files, [](const std::string& warning) { fuzz::keep(warning); });
    try {
      printScene(files.add("input", std::string(text)), LAMPYRIS_FUZZ_FILES, {}, files, diagnostics,
                 [](std::string_view piece) { fuzz::keep(piece); });
    } catch (const SceneError& e) {
      fuzz::keep(formatMessage(files, e.location, "error", e.what()));
    }
  });
}
