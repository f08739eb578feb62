// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "tools/render_settings.h"

namespace lampyris {

/// Prints the scene (settings.print) to standard output. Returns an exit code; throws IoError.
int runPrint(const RenderSettings& settings);

}  // namespace lampyris
