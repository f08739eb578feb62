// SPDX-License-Identifier: Apache-2.0
#include "samplers/address_hash.h"

namespace lampyris {

namespace {

class RandomSampler final : public Sampler {
 public:
  RandomSampler(int count, uint64_t seed) : hash_(seed), count_(count) {}
  float get1D(const SampleAddress& a, uint32_t dimension) const override {
    return toUnitFloat(hash_(a.pixel, dimension, a.index));
  }
  Vec2 get2D(const SampleAddress& a, uint32_t dimension) const override {
    const uint64_t h = hash_(a.pixel, dimension, a.index);
    return {toUnitFloat(h), toUnitFloat(static_cast<uint32_t>(h))};
  }
  int samplesPerPixel() const override { return count_; }

 private:
  AddressHash hash_;
  int count_;
};

std::unique_ptr<Sampler> create(const PixelSamplesParameters& p, const SamplerContext& context) {
  return std::make_unique<RandomSampler>(p.count(context), context.seed);
}

}  // namespace

SamplerRegistry::Entry randomSamplerPlugin() {
  return makePlugin("random", "Independent uniform numbers.", create);
}

}  // namespace lampyris
