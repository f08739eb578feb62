// SPDX-License-Identifier: Apache-2.0
/// Hashes of addresses for samplers.
#pragma once

#include "base/sampler.h"
#include "core/hash.h"

namespace lampyris {

/// 64 random bits of a pixel (or tile), a dimension and a number `n`. Two rounds of mixing: pixels
/// enter the first one bijectively, so no two share a state.
class AddressHash {
 public:
  explicit AddressHash(uint64_t seed) : key_(mixBits(seed + 0x9e3779b97f4a7c15ULL)) {}
  uint64_t operator()(const Int2& pixel, uint32_t dimension, uint64_t n) const {
    const uint64_t place = static_cast<uint64_t>(static_cast<uint32_t>(pixel.x)) |
                           static_cast<uint64_t>(static_cast<uint32_t>(pixel.y)) << 32;
    return mixBits(mixBits(place ^ key_) + dimension * 0xd1342543de82ef95ULL +
                   n * 0x9e3779b97f4a7c15ULL);
  }

 private:
  uint64_t key_;
};

/// The parameter that samplers share.
struct PixelSamplesParameters {
  int pixelSamples = 16;
  void declare(Declaration& d) {
    d.add("pixelsamples", pixelSamples, "Samples per pixel.").range(1, 1 << 30);
  }
  int count(const SamplerContext& context) const {
    return context.samplesPerPixel > 0 ? context.samplesPerPixel : pixelSamples;
  }
};

}  // namespace lampyris
