// SPDX-License-Identifier: Apache-2.0
/// From tokens to a description: the directives of pbrt-v3's file format.
#pragma once

#include "core/error.h"
#include "scene/description.h"

namespace lampyris {

/// Reads a scene from `mainFile` and the files that it includes (their names count from `folder`,
/// the main file's, as in pbrt-v3). Throws SceneError; warnings go to `diagnostics`. The result
/// points into `files`.
Description parseScene(uint16_t mainFile, const std::string& folder, SourceFiles& files,
                       Diagnostics& diagnostics);

/// The path of a file that a scene names: relative names count from `folder`.
std::string resolveScenePath(const std::string& folder, std::string_view name);

}  // namespace lampyris
