// SPDX-License-Identifier: Apache-2.0
/// What a film keeps of each pixel, and its form in a checkpoint.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

#include "base/aov.h"
#include "core/bounds.h"

namespace lampyris {

struct PixelSums {
  double r = 0, g = 0, b = 0;   ///< Σ weight × radiance
  double luminanceSquares = 0;  ///< Σ (weight × luminance)²
  uint64_t count = 0;           ///< samples, the black ones included

  bool operator==(const PixelSums&) const = default;
};

/// What the sums are of.
struct SumsKey {
  PixelBounds bounds;
  AovSet aovs;
};

/// Depends on every bit and on the order; `size` is a multiple of 8.
uint64_t checksum(const char* bytes, size_t size);
/// Header (magic, version, key), sums, those of the AOVs, checksum; little-endian.
std::string encodeSums(const SumsKey& key, std::span<const PixelSums> sums,
                       std::span<const double> aovSums);
/// Back; false, with the outputs untouched, if the bytes are damaged or of another key.
bool decodeSums(std::string_view bytes, const SumsKey& key, std::span<PixelSums> sums,
                std::span<double> aovSums);

}  // namespace lampyris
