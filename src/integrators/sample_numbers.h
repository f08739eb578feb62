// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <bit>

#include "base/medium.h"
#include "base/sampler.h"

namespace lampyris {

/// For whatever of a sample the sampler's dimensions do not cover; takes the number of `dimension`.
inline NumberSequence numbersBeyond(SampleStream& stream, uint32_t dimension) {
  stream.setDimension(dimension);
  const SampleAddress& a = stream.address();
  const uint64_t pixel =
      hashCombine(static_cast<uint32_t>(a.pixel.x), static_cast<uint32_t>(a.pixel.y));
  const auto seeded = std::bit_cast<uint32_t>(stream.next1D());
  return NumberSequence(hashCombine(hashCombine(pixel, a.index), seeded));
}

}  // namespace lampyris
