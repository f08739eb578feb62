// SPDX-License-Identifier: Apache-2.0
#include "cameras/exit_pupil.h"
#include "cameras/lens_file.h"
#include "target.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace lampyris;
  return fuzz::run<std::runtime_error>(
      data, size, fuzz::kMebi + 256 * size, [](std::string_view text) {
        LensSystem lens(readLens(text));
        lens.focus(1, 35e-6);
        for (int i = 0; i < 32; ++i)
          fuzz::keep(lens.traceFromFilm({DVec3(0.0005 * i, 0, 0), DVec3(0, 0, lens.rearZ())}));
        fuzz::keep(lens.traceFromScene({DVec3(0.001, 0, 10), DVec3(0, 0, -1)}));
      });
}
