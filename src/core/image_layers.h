// SPDX-License-Identifier: Apache-2.0
/// What EXR files hold beside the image itself: layers, channels like "albedo.R", and its place.
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
/// Where the image lies within the whole one: the data window in the display window. Throws
/// IoError.
ImagePlacement readExrPlacement(const std::string& path);

}  // namespace lampyris
