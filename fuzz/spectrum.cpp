// SPDX-License-Identifier: Apache-2.0
#include "core/spectrum.h"

#include "scene/spectrum_files.h"
#include "target.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace lampyris;
  return fuzz::run<SceneError>(data, size, fuzz::kMebi + 64 * size, [](std::string_view text) {
    SourceFiles files;
    const uint16_t file = files.add("input", std::string(text));
    try {
      fuzz::keep(spectrumToRgb(readSpectrum(files, file)));
    } catch (const SceneError& e) {
      fuzz::keep(formatMessage(files, e.location, "error", e.what()));
    }
  });
}
