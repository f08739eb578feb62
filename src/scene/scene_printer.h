// SPDX-License-Identifier: Apache-2.0
/// Scene files as they are meant: one text in an even layout, which renders to the same image.
#pragma once

#include <functional>
#include <string>
#include <string_view>

#include "core/error.h"

namespace lampyris {

struct PrintOptions {
  /// Triangle meshes that PLY files can hold are written to mesh_00001.ply … in the scene's folder.
  bool meshesToPly = false;
};

/// Reads a scene and what it includes, as parseScene() does and with its errors, and hands the text
/// to `out` in pieces: without comments, included files in place, all values as they were written.
/// Files that the text names count from the scene's folder, as before. Throws SceneError, IoError.
void printScene(uint16_t mainFile, const std::string& folder, const PrintOptions& options,
                SourceFiles& files, Diagnostics& diagnostics,
                const std::function<void(std::string_view)>& out);

}  // namespace lampyris
