// SPDX-License-Identifier: Apache-2.0
/// How far an image is from a reference.
#pragma once

#include <optional>
#include <string>

#include "core/image.h"

namespace lampyris {

/// Over all pixels and the three channels of linear RGB, a: the image, b: the reference. Pixels
/// where either is not finite count in `notFinite` only.
struct Comparison {
  std::string error;     ///< not empty: the images cannot be compared; says why
  size_t pixels = 0;     ///< that were compared
  size_t notFinite = 0;  ///< pixels left out
  double meanImage = 0, meanReference = 0;
  double mse = 0;       ///< mean of (a − b)²
  double rmse = 0;      ///< √mse
  double mae = 0;       ///< mean of |a − b|
  double maxError = 0;  ///< largest |a − b|
  // None where the reference is black (its mean is 0).
  std::optional<double> meanRatio;  ///< mean of a / mean of b
  /// Mean of (a − b)² / (b² + ε), ε = (0.01 mean of b)²: the same for images scaled together.
  std::optional<double> relMse;
  /// The same without the 0.1 % of the pixels that have the largest terms (fireflies).
  std::optional<double> trimmedRelMse;
};

/// Images of different sizes give an `error`.
Comparison compareImages(const Image& image, const Image& reference);

/// A table for people, one figure a line; the error if there is one.
std::string formatComparison(const Comparison& comparison);

/// The relative error per pixel, √ of the mean of relMSE's terms over the channels, in false colour
/// (linear RGB): from 0.001 and less (black) over violet, red and orange to 1 and more (white), the
/// lightness linear in the error's logarithm. Pixels that are not finite are green. Where the
/// reference is black, any error is white. Throws std::invalid_argument if the sizes differ.
Image errorImage(const Image& image, const Image& reference);

/// The colour of `t` in [0, 1] in the map above, linear RGB.
Rgb errorColour(float t);

}  // namespace lampyris
