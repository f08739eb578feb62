// SPDX-License-Identifier: Apache-2.0
/// Walks over two images at once.
#pragma once

#include <fmt/format.h>

#include <array>
#include <string>

#include "core/image.h"
#include "core/math.h"

namespace lampyris {

inline std::array<double, 3> channels(const Rgb& c) {
  return {static_cast<double>(c.r), static_cast<double>(c.g), static_cast<double>(c.b)};
}

/// Why the images cannot be compared; "" if they can.
inline std::string sizeError(const Image& a, const Image& b) {
  if (a.empty() || b.empty()) return "an image without pixels cannot be compared";
  if (a.width() == b.width() && a.height() == b.height()) return "";
  return fmt::format("the images differ in size: {} x {} and {} x {} pixels", a.width(), a.height(),
                     b.width(), b.height());
}

/// Calls f(x, y, a, b) for the pixels where both images are finite; returns how many are not.
template <class F>
size_t forFinitePixels(const Image& image, const Image& reference, F&& f) {
  size_t skipped = 0;
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) {
      const Rgb a = image.rgb(x, y), b = reference.rgb(x, y);
      if (a.isFinite() && b.isFinite()) {
        f(x, y, channels(a), channels(b));
      } else {
        ++skipped;
      }
    }
  return skipped;
}

/// Mean over the channels of (a − b)² / (b² + ε).
inline double relativeSquare(const std::array<double, 3>& a, const std::array<double, 3>& b,
                             double epsilon) {
  double sum = 0;
  for (size_t c = 0; c < 3; ++c) sum += sqr(a[c] - b[c]) / (sqr(b[c]) + epsilon);
  return sum / 3;
}

/// ε of relative errors: the square of a hundredth of the reference's mean, so that images scaled
/// together have the same error.
inline double relativeFloor(double meanReference) { return sqr(0.01 * meanReference); }

}  // namespace lampyris
