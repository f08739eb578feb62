// SPDX-License-Identifier: Apache-2.0
#include "shapes/ply_file.h"
#include "target.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  using namespace lampyris;
  // A vertex of three bytes becomes 12 bytes of position, 12 of a normal, and lists of indices grow
  // by doubling.
  return fuzz::run<std::runtime_error>(data, size, fuzz::kMebi + 128 * size,
                                       [](std::string_view text) {
                                         const PlyMesh mesh = parsePly(text);
                                         for (const uint32_t i : mesh.data.indices)
                                           if (i >= mesh.data.positions.size()) __builtin_trap();
                                       });
}
