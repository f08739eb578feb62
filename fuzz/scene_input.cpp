// SPDX-License-Identifier: Apache-2.0
#include "scene_input.h"

#include "core/memory.h"
#include "core/parallel.h"

namespace lampyris::fuzz {

int loadScene(std::string_view text, BuildOptions options) {
  // A few words can ask for a large film: what is refused depends on the memory that there is, and
  // clearing what is not refused takes time.
  constexpr size_t kFilm = 4 * kMebi;
  static const ThreadLimit threads(1);
  limitMemory(kFilm);
  if (options.cropWindow.empty()) options.cropWindow = {0, 0.05f, 0, 0.05f};
  const Bounds bound(256 * kMebi + 4096 * text.size());
  SourceFiles files;
  Statistics statistics;
  Diagnostics diagnostics(files, [](const std::string& warning) { keep(warning); });
  try {
    keep(loadSceneText(std::string(text), LAMPYRIS_FUZZ_FILES, options, files, diagnostics,
                       statistics));
  } catch (const SceneError& e) {
    keep(formatMessage(files, e.location, "error", e.what()));
  } catch (const IoError& e) {
    keep(e);
  }
  return 0;
}

}  // namespace lampyris::fuzz
