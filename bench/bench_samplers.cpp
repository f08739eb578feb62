// SPDX-License-Identifier: Apache-2.0
// Cost of one number, and of one pair, of each sampler.
#include <benchmark/benchmark.h>

#include "samplers/registry.h"

namespace {

using namespace lampyris;

template <bool kPairs>
void drawNumbers(benchmark::State& state, const SamplerRegistry::Entry* entry) {
  SamplerContext context;
  context.samplesPerPixel = 64;
  const auto sampler = entry->create({}, context);
  SampleAddress address{{317, 211}, 0};
  uint32_t dimension = 0;
  float sum = 0;
  for (auto _ : state) {
    if constexpr (kPairs) {
      const Vec2 u = sampler->get2D(address, dimension);
      sum += u.x + u.y;
    } else {
      sum += sampler->get1D(address, dimension);
    }
    dimension += 2;
    if (dimension == 64) {
      dimension = 0;
      ++address.index;
    }
  }
  benchmark::DoNotOptimize(sum);
}

const bool kRegistered = [] {
  for (const auto& entry : samplerRegistry().entries()) {
    benchmark::RegisterBenchmark((entry.name + "/1D").c_str(), drawNumbers<false>, &entry);
    benchmark::RegisterBenchmark((entry.name + "/2D").c_str(), drawNumbers<true>, &entry);
  }
  return true;
}();

}  // namespace
