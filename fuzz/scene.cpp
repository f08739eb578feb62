// SPDX-License-Identifier: Apache-2.0
// A scene file, from its text to the objects of a render.
#include "core/memory.h"
#include "core/parallel.h"
#include "scene/builder.h"
#include "target.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace lampyris;
  // A few words can ask for a large film: what is refused depends on the memory that there is, and
  // clearing what is not refused takes time.
  constexpr size_t kFilm = fuzz::kMebi / 4;
  static const ThreadLimit threads(1);
  limitMemory(kFilm);
  return fuzz::run<IoError>(data, size, 256 * fuzz::kMebi + 4096 * size, [](std::string_view text) {
    BuildOptions options;
    options.cropWindow = {0, 0.05f, 0, 0.05f};
    SourceFiles files;
    Statistics statistics;
    Diagnostics diagnostics(files, [](const std::string& warning) { fuzz::keep(warning); });
    try {
      fuzz::keep(loadSceneText(std::string(text), LAMPYRIS_FUZZ_FILES, options, files, diagnostics,
                               statistics));
    } catch (const SceneError& e) {
      fuzz::keep(formatMessage(files, e.location, "error", e.what()));
    }
  });
}
