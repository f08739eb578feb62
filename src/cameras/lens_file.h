// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>
#include <vector>

#include "cameras/lens_system.h"

namespace lampyris {

/// Reads a lens description: four numbers an element (radius of curvature, thickness, index of
/// refraction, diameter of the aperture, lengths in millimetres), `#` to the end of the line is a
/// comment. Throws std::runtime_error that names the line.
std::vector<LensElement> readLens(std::string_view text);

}  // namespace lampyris
