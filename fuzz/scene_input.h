// SPDX-License-Identifier: Apache-2.0
/// Loads a text as a scene file.
#pragma once

#include "scene/builder.h"
#include "target.h"

namespace lampyris::fuzz {

/// Everything that the text may name besides lies in LAMPYRIS_FUZZ_FILES.
int loadScene(std::string_view text, BuildOptions options);

}  // namespace lampyris::fuzz
