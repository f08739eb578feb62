// SPDX-License-Identifier: Apache-2.0
/// How far an image is from a reference.
#pragma once

#include <optional>
#include <string>

#include "core/image.h"
#include "tools/mean_ratio.h"

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
  /// Mean of 2 (a − b)² / (a² + b² + 2 ε): equal to relMse for small errors, while no pixel,
  /// however wrong, adds more than 2.
  std::optional<double> robustRelMse;
  MeanRatios meanRatios;  ///< by channel, with confidence intervals
};

/// Images of different sizes give an `error`.
Comparison compareImages(const Image& image, const Image& reference);

/// A table for people, one figure a line; the error if there is one.
std::string formatComparison(const Comparison& comparison);
/// The same for programs: a JSON object; figures that are undefined are null.
std::string comparisonJson(const Comparison& comparison);

}  // namespace lampyris
