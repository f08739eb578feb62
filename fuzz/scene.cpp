// SPDX-License-Identifier: Apache-2.0
// A scene file, from its text to the objects of a render.
#include "scene_input.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  return lampyris::fuzz::loadScene({reinterpret_cast<const char*>(data), size}, {});
}
