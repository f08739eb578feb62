// SPDX-License-Identifier: Apache-2.0
/// Layers of EXR files: channels beside the image itself, like "albedo.R".
#pragma once

#include <string>
#include <vector>

#include "core/image.h"

namespace lampyris {

/// The layers of an EXR file, in the order of their names; none where it has only an image. Throws
/// IoError.
std::vector<std::string> exrLayerNames(const std::string& path);
/// A layer's channels R, G, B or X, Y, Z, or its only one. Throws IoError, with the names of the
/// layers where there is none of this name.
Image readExrLayer(const std::string& path, const std::string& layer);

}  // namespace lampyris
