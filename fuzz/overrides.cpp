// SPDX-License-Identifier: Apache-2.0
// What -D changes of a scene, a setting a line: everything before the scene's world is built.
#include "scene/overrides.h"

#include "core/memory.h"
#include "scene/build_state.h"
#include "scene/parser.h"
#include "target.h"

namespace lampyris::fuzz {

namespace {

constexpr std::string_view kScene = R"(
Film "image" "integer xresolution" 4 "integer yresolution" 4
Camera "perspective"
WorldBegin
WorldEnd
)";
/// A few words can ask for a large film, and clearing it takes time: this limits it.
constexpr size_t kFilm = kMebi / 4;

/// The scene, read once.
struct Base {
  Base() { limitMemory(kFilm); }
  SourceFiles files;
  Diagnostics diagnostics{files, [](const std::string& warning) { keep(warning); }};
  Description description =
      parseScene(files.add("scene", std::string(kScene)), LAMPYRIS_FUZZ_FILES, files, diagnostics);
};

BuildOptions optionsOf(std::string_view text) {
  BuildOptions options;
  while (!text.empty()) {
    const size_t end = std::min(text.find('\n'), text.size());
    const std::string_view line = text.substr(0, end);
    const size_t equals = std::min(line.find('='), line.size());
    options.overrides.emplace_back(line.substr(0, equals),
                                   line.substr(std::min(equals + 1, line.size())));
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return options;
}

}  // namespace

}  // namespace lampyris::fuzz

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace lampyris;
  static fuzz::Base base;
  return fuzz::run<SceneError>(data, size, 8 * fuzz::kMebi + 4096 * size, [](std::string_view t) {
    const BuildOptions options = fuzz::optionsOf(t);
    Statistics statistics;
    RenderJob job;
    BuildState state(base.description, options, LAMPYRIS_FUZZ_FILES, base.files, base.diagnostics,
                     statistics, job);
    buildView(state);
    fuzz::keep(chooseIntegrator(state));
  });
}
