// SPDX-License-Identifier: Apache-2.0
/// Integer hashes: the source of all randomness, so that every number is a function of its address.
#pragma once

#include <cstdint>

#include "core/math.h"

namespace lampyris {

/// A bijective mix of 64 bits (the finaliser "Mix13" of Stafford 2011).
constexpr uint64_t mixBits(uint64_t v) {
  v ^= v >> 30;
  v *= 0xbf58476d1ce4e5b9ULL;
  v ^= v >> 27;
  v *= 0x94d049bb133111ebULL;
  v ^= v >> 31;
  return v;
}

/// A hash of two words; chain it for more.
constexpr uint64_t hashCombine(uint64_t a, uint64_t b) {
  return mixBits(a * 0x9e3779b97f4a7c15ULL + mixBits(b + 0x632be59bd9b4e019ULL));
}

/// The 24 highest bits of `h` as a float in [0, 1).
constexpr float toUnitFloat(uint64_t h) { return static_cast<float>(h >> 40) * 0x1p-24f; }
constexpr float toUnitFloat(uint32_t h) { return static_cast<float>(h >> 8) * 0x1p-24f; }

}  // namespace lampyris
