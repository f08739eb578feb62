// SPDX-License-Identifier: Apache-2.0
// Ahmed and Wonka 2020, "Screen-Space Blue-Noise Diffusion of Monte Carlo Sampling Error via
// Hierarchical Ordering of Pixels" (ACM TOG 39(6)): pixels in the order of a space-filling curve
// take consecutive runs of one Owen-scrambled Sobol' sequence, so that the samples of every 2×2,
// 4×4, … block of pixels are stratified together and neighbouring errors cancel. The order is
// Morton's, with the digits permuted at random for each pair of dimensions.
//
// Deviations: the hierarchy ends at tiles of 256×256 pixels, each with a sequence of its own, so
// that 32 bits hold pixel and sample; the digits are permuted by one hash (owen.h) instead of one
// for each digit; and the samples beyond the planned ones come in runs that double in length, each
// again distributed over the image in this way, so that rendering on converges as fast. A count
// that is no power of two is drawn from the next larger plan: neighbours' errors then cancel
// little.
#include <array>
#include <bit>

#include "samplers/address_hash.h"
#include "samplers/owen.h"

namespace lampyris {

namespace {

/// Bits of a coordinate within its tile.
constexpr int kTileBits = 8;

/// The bits of a coordinate, reversed, at even places.
constexpr auto kReversedSpread = [] {
  std::array<uint16_t, 1 << kTileBits> table{};
  for (size_t c = 0; c < table.size(); ++c)
    for (int b = 0; b < kTileBits; ++b)
      if (c >> b & 1) table[c] = static_cast<uint16_t>(table[c] | 1 << 2 * (kTileBits - 1 - b));
  return table;
}();

class BlueNoiseSampler final : public Sampler {
 public:
  BlueNoiseSampler(int count, uint64_t seed)
      : hash_(seed),
        count_(count),
        sampleBits_(static_cast<int>(std::bit_width(static_cast<uint32_t>(count - 1)))),
        tileBits_(std::min(kTileBits, (32 - sampleBits_) / 2)),
        digits_(static_cast<uint32_t>(0x55555555u & ((uint64_t{1} << 2 * tileBits_) - 1))) {}

  float get1D(const SampleAddress& a, uint32_t dimension) const override {
    const Place place = locate(a, dimension);
    return owenPoint1D(place.index, place.seed);
  }
  Vec2 get2D(const SampleAddress& a, uint32_t dimension) const override {
    const Place place = locate(a, dimension);
    return owenPoint2D(place.index, place.seed);
  }
  int samplesPerPixel() const override { return count_; }

 private:
  struct Place {
    uint32_t index;  ///< in the tile's sequence
    uint64_t seed;
  };

  Place locate(const SampleAddress& a, uint32_t dimension) const {
    // Run 0 has 2^sampleBits samples, run r > 0 has 2^(sampleBits + r − 1): twice as many in all.
    const auto run = static_cast<int>(std::bit_width(a.index >> sampleBits_));
    int bits = sampleBits_;
    uint64_t sample = a.index;
    if (run > 0) {
      bits += run - 1;
      sample -= uint64_t{1} << bits;
    }
    // What doesn't fit 32 bits beside the pixel starts a new sequence.
    bits = std::min(bits, 32 - 2 * tileBits_);
    const uint64_t chunk = sample >> bits;
    const auto within = static_cast<uint32_t>(sample & ((uint64_t{1} << bits) - 1));

    const Int2 tile(a.pixel.x >> tileBits_, a.pixel.y >> tileBits_);
    const uint64_t h = hash_(tile, dimension, chunk << 8 | static_cast<uint64_t>(run));
    const uint32_t pixel = spread(a.pixel.x) << 1 | spread(a.pixel.y);
    const int total = bits + 2 * tileBits_;
    const auto reversed =
        static_cast<uint32_t>(uint64_t{reverseBits(within)} >> (32 - total)) | pixel;
    const uint32_t shuffled = scrambleReversedBase4(
        reversed, static_cast<uint32_t>((h * 0xd1342543de82ef95ULL) >> 32), digits_);
    return {static_cast<uint32_t>(uint64_t{reverseBits(shuffled)} >> (32 - total)), h};
  }
  uint32_t spread(int coordinate) const {
    const uint32_t within = static_cast<uint32_t>(coordinate) << (kTileBits - tileBits_);
    return kReversedSpread[within & ((1u << kTileBits) - 1)];
  }

  AddressHash hash_;
  int count_;
  int sampleBits_, tileBits_;
  uint32_t digits_;  ///< of the pixel's place in its tile, for scrambleReversedBase4
};

std::unique_ptr<Sampler> create(const PixelSamplesParameters& p, const SamplerContext& context) {
  return std::make_unique<BlueNoiseSampler>(p.count(context), context.seed);
}

}  // namespace

SamplerRegistry::Entry blueNoiseSamplerPlugin() {
  return makePlugin("bluenoise",
                    "Owen-scrambled Sobol' points, arranged so that the error of neighbouring "
                    "pixels cancels (best for powers of two); the default.",
                    create);
}

}  // namespace lampyris
