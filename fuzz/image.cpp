// SPDX-License-Identifier: Apache-2.0
// One of the image readers: READER.
#include "core/image_formats.h"
#include "target.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace lampyris;
  // What kMaxPixelsPerByte allows, as floats of four channels beside the decoder's own copies.
  const size_t bound = 64 * fuzz::kMebi + 8 * 4 * kMaxPixelsPerByte * size;
  return fuzz::run<IoError>(data, size, bound,
                            [](std::string_view text) { fuzz::keep(READER("input", text)); });
}
