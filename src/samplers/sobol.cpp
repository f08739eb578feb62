// SPDX-License-Identifier: Apache-2.0
// Padded (0,2)-sequences: every pair of dimensions is the two-dimensional Sobol' sequence under an
// Owen scramble and an index shuffle of its own, as is every pixel (Burley 2020, §4; see owen.h).
// It stands for pbrt-v3's halton, sobol, 02sequence and maxmindist samplers: any prefix of 2^k
// samples of a pixel is stratified in all elementary intervals, and no dimension is a bad one.
#include "samplers/address_hash.h"
#include "samplers/owen.h"

namespace lampyris {

namespace {

struct HaltonParameters : PixelSamplesParameters {
  void declare(Declaration& d) {
    PixelSamplesParameters::declare(d);
    d.ignored("samplepixelcenter", "samples are spread over the pixel by its filter");
  }
};
struct ZeroTwoParameters : PixelSamplesParameters {
  void declare(Declaration& d) {
    PixelSamplesParameters::declare(d);
    d.ignored("dimensions", "every dimension is well distributed");
  }
};

class PaddedSobolSampler final : public Sampler {
 public:
  PaddedSobolSampler(int count, uint64_t seed) : hash_(seed), count_(count) {}
  float get1D(const SampleAddress& a, uint32_t dimension) const override {
    const uint64_t h = hash_(a.pixel, dimension, a.index >> 32);
    return owenPoint1D(shuffled(a.index, h), h);
  }
  Vec2 get2D(const SampleAddress& a, uint32_t dimension) const override {
    const uint64_t h = hash_(a.pixel, dimension, a.index >> 32);
    return owenPoint2D(shuffled(a.index, h), h);
  }
  int samplesPerPixel() const override { return count_; }

 private:
  static uint32_t shuffled(uint64_t index, uint64_t h) {
    return shuffleIndex(static_cast<uint32_t>(index),
                        static_cast<uint32_t>((h * 0xd1342543de82ef95ULL) >> 32));
  }
  AddressHash hash_;
  int count_;
};

template <class P>
std::unique_ptr<Sampler> create(const P& p, const SamplerContext& context) {
  return std::make_unique<PaddedSobolSampler>(p.count(context), context.seed);
}

}  // namespace

SamplerRegistry::Entry sobolSamplerPlugin() {
  return makePlugin("sobol", "Owen-scrambled Sobol' points, pair by pair of dimensions.",
                    create<PixelSamplesParameters>);
}
SamplerRegistry::Entry haltonSamplerPlugin() {
  return makePlugin("halton", "The same points as sobol, in place of pbrt-v3's Halton points.",
                    create<HaltonParameters>);
}
SamplerRegistry::Entry zeroTwoSamplerPlugin() {
  return makePlugin("02sequence", "The same points as sobol: a (0,2)-sequence for each pair.",
                    create<ZeroTwoParameters>, {"lowdiscrepancy"});
}
SamplerRegistry::Entry maxMinDistSamplerPlugin() {
  return makePlugin("maxmindist", "The same points as sobol, in place of pbrt-v3's.",
                    create<ZeroTwoParameters>);
}

}  // namespace lampyris
