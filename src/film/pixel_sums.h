// SPDX-License-Identifier: Apache-2.0
/// What a film keeps of each pixel, and its form in a file.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "base/aov.h"
#include "core/bounds.h"
#include "core/wide_sum.h"

namespace lampyris {

struct PixelSums {
  WideSum r, g, b;              ///< Σ weight × radiance
  double luminanceSquares = 0;  ///< Σ (weight × luminance)²: for an estimate, not for the image
  uint64_t count = 0;           ///< samples, the black ones included

  bool operator==(const PixelSums&) const = default;
};

/// What the sums are of.
struct FilmFrame {
  Int2 resolution{0};  ///< of the whole image
  PixelBounds bounds;  ///< the pixels that there are sums of
  AovSet aovs;
  double scale = 1;  ///< factor on the pixels of the image
};

/// Depends on every bit and on the order; `size` is a multiple of 8.
uint64_t checksum(const char* bytes, size_t size);
/// Header (magic, version, frame, tail), sums, those of the AOVs, checksum; little-endian. `tail`:
/// bytes that the caller lets follow.
std::string encodeSums(const FilmFrame& frame, std::span<const PixelSums> sums,
                       std::span<const WideSum> aovSums, size_t tail);
/// What encoded sums are of, as far as their header tells; none if they are too short for one.
std::optional<FilmFrame> frameOfSums(std::string_view bytes);
/// Back; false, with the outputs untouched, if the bytes are damaged, or of another frame or
/// tail. The tail is not among them.
bool decodeSums(std::string_view bytes, const FilmFrame& frame, std::span<PixelSums> sums,
                std::span<WideSum> aovSums, size_t tail);

}  // namespace lampyris
