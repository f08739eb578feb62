// SPDX-License-Identifier: Apache-2.0
/// Where an image differs from a reference, in false colour.
#pragma once

#include "core/image.h"

namespace lampyris {

/// The relative error per pixel, √ of the mean of relMSE's terms over the channels, in false colour
/// (linear RGB): from 0.001 and less (black) over violet, red and orange to 1 and more (white), the
/// lightness linear in the error's logarithm. Pixels that are not finite are green. Where the
/// reference is black, any error is white. Throws std::invalid_argument if the sizes differ.
Image errorImage(const Image& image, const Image& reference);

/// The colour of `t` in [0, 1] in the map above, linear RGB.
Rgb errorColour(float t);

}  // namespace lampyris
