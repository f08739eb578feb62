// SPDX-License-Identifier: Apache-2.0
/// Samplers: random numbers by address.
#pragma once

#include <memory>

#include "core/bounds.h"
#include "core/registry.h"
#include "core/vector.h"

namespace lampyris {

/// Which sample: a pixel and the index of the sample in it.
struct SampleAddress {
  Int2 pixel{0};
  uint64_t index = 0;
};

/// A map (address, dimension) → [0, 1). Pure: the same address gives the same number, in any order,
/// on any thread. Numbers of one dimension are uniform over the indices; as many as samplesPerPixel
/// of them are well distributed.
class Sampler {
 public:
  virtual ~Sampler() = default;
  virtual float get1D(const SampleAddress& address, uint32_t dimension) const = 0;
  /// Takes two dimensions: `dimension` and the next.
  virtual Vec2 get2D(const SampleAddress& address, uint32_t dimension) const = 0;
  virtual int samplesPerPixel() const = 0;
};

/// The numbers of one sample, dimension after dimension.
class SampleStream {
 public:
  SampleStream(const Sampler& sampler, const SampleAddress& address)
      : sampler_(&sampler), address_(address) {}
  float next1D() { return sampler_->get1D(address_, dimension_++); }
  Vec2 next2D() {
    const uint32_t d = dimension_;
    dimension_ += 2;
    return sampler_->get2D(address_, d);
  }
  /// Jumps, so that later numbers keep their dimension whatever was drawn before.
  void setDimension(uint32_t d) { dimension_ = d; }
  uint32_t dimension() const { return dimension_; }
  const SampleAddress& address() const { return address_; }

 private:
  const Sampler* sampler_;
  SampleAddress address_;
  uint32_t dimension_ = 0;
};

struct SamplerContext {
  int samplesPerPixel = 0;  ///< overrides the scene file's if > 0 (`--spp`)
  uint64_t seed = 0;
  PixelBounds pixels;
};

using SamplerRegistry = Registry<Sampler, SamplerContext>;

}  // namespace lampyris
