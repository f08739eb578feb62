// SPDX-License-Identifier: Apache-2.0
// Jittered sampling: one sample per stratum, strata taken in an order that is hashed anew for each
// pixel and dimension, so that dimensions are independent.
#include <cmath>

#include "samplers/address_hash.h"

namespace lampyris {

namespace {

struct StratifiedParameters {
  int xSamples = 4, ySamples = 4;
  bool jitter = true;
  void declare(Declaration& d) {
    d.add("xsamples", xSamples, "Strata along x.").range(1, 1 << 15);
    d.add("ysamples", ySamples, "Strata along y.").range(1, 1 << 15);
    d.add("jitter", jitter, "Random places in the strata instead of their centres.");
    d.ignored("dimensions", "every dimension is stratified");
  }
};

/// A permutation of [0, count) chosen by `key`: a bijection of the next power of two, repeated
/// until it falls below `count` (cycle walking, Black and Rogaway 2002), < 2 rounds on average.
uint32_t permute(uint32_t i, uint32_t count, uint64_t key) {
  const auto bits = static_cast<int>(std::bit_width(count - 1));
  if (bits == 0) return 0;
  const uint32_t mask = static_cast<uint32_t>((uint64_t{1} << bits) - 1);
  const int shift = (bits + 1) / 2;
  const auto k0 = static_cast<uint32_t>(key), k1 = static_cast<uint32_t>(key >> 32);
  do {
    i = (i ^ k0) & mask;
    i = (i * (k1 | 1)) & mask;
    i ^= i >> shift;
    i = (i + (k0 >> 15) + (k1 >> 9)) & mask;
    i = (i * 0x9e3779b1u) & mask;
    i ^= i >> shift;
    i = (i * ((k0 >> 8) | 1) + (k1 >> 17)) & mask;
    i ^= i >> shift;
    i = (i * 0x85ebca6bu + (k0 >> 3)) & mask;
  } while (i >= count);
  return i;
}

class StratifiedSampler final : public Sampler {
 public:
  StratifiedSampler(int count, Int2 grid, bool jitter, uint64_t seed)
      : hash_(seed),
        count_(static_cast<uint32_t>(count)),
        width_(static_cast<uint32_t>(grid.x)),
        height_(static_cast<uint32_t>(grid.y)),
        jitter_(jitter) {}

  float get1D(const SampleAddress& a, uint32_t dimension) const override {
    const uint64_t key = hash_(a.pixel, dimension, a.index / count_);
    const auto i = static_cast<uint32_t>(a.index % count_);
    const uint64_t random = mixBits(key + i);
    return within(permute(i, count_, key), count_, static_cast<uint32_t>(random));
  }
  Vec2 get2D(const SampleAddress& a, uint32_t dimension) const override {
    const uint32_t cells = width_ * height_;
    const uint64_t key = hash_(a.pixel, dimension, a.index / cells);
    const auto i = static_cast<uint32_t>(a.index % cells);
    const uint64_t random = mixBits(key + i);
    const uint32_t cell = permute(i, cells, key);
    return {within(cell % width_, width_, static_cast<uint32_t>(random)),
            within(cell / width_, height_, static_cast<uint32_t>(random >> 32))};
  }
  int samplesPerPixel() const override { return static_cast<int>(count_); }

 private:
  float within(uint32_t stratum, uint32_t strata, uint32_t random) const {
    const float offset = jitter_ ? toUnitFloat(random) : 0.5f;
    return std::min((static_cast<float>(stratum) + offset) / static_cast<float>(strata),
                    kOneMinusEpsilon);
  }
  AddressHash hash_;
  uint32_t count_, width_, height_;
  bool jitter_;
};

std::unique_ptr<Sampler> create(const StratifiedParameters& p, const SamplerContext& context) {
  const int own = p.xSamples * p.ySamples;
  const int count = context.samplesPerPixel > 0 ? context.samplesPerPixel : own;
  Int2 grid(p.xSamples, p.ySamples);
  if (count != own) {
    // The smallest grid of about the same shape with a cell for every sample.
    const double shape = static_cast<double>(p.xSamples) / p.ySamples;
    grid.x = std::clamp(static_cast<int>(std::lround(std::sqrt(count * shape))), 1, count);
    grid.y = static_cast<int>((int64_t{count} + grid.x - 1) / grid.x);
  }
  return std::make_unique<StratifiedSampler>(count, grid, p.jitter, context.seed);
}

}  // namespace

SamplerRegistry::Entry stratifiedSamplerPlugin() {
  return makePlugin("stratified", "One sample in each cell of a grid.", create);
}

}  // namespace lampyris
