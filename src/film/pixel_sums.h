// SPDX-License-Identifier: Apache-2.0
/// What a film keeps of each pixel, and its form in a checkpoint.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "core/bounds.h"

namespace lampyris {

struct PixelSums {
  double r = 0, g = 0, b = 0;   ///< Σ weight × radiance
  double luminanceSquares = 0;  ///< Σ (weight × luminance)²
  uint64_t count = 0;           ///< samples, the black ones included

  bool operator==(const PixelSums&) const = default;
};

/// Header (magic, version, bounds), sums, checksum; little-endian.
std::string encodeSums(const PixelBounds& bounds, std::span<const PixelSums> sums);
/// Back; false, with `out` untouched, if the bytes are damaged or of other bounds.
bool decodeSums(std::string_view bytes, const PixelBounds& bounds, std::span<PixelSums> out);

}  // namespace lampyris
