// SPDX-License-Identifier: Apache-2.0
/// How fast this machine is, by work that no change of the project alters: what bench/run divides
/// all other figures by.
#include <benchmark/benchmark.h>

#include <cmath>
#include <cstdint>
#include <vector>

namespace {

/// A chain of dependent float operations with roots and divisions, as shading has them.
void arithmetic(benchmark::State& state) {
  float x = 1.5f;
  for (auto _ : state) {
    for (int i = 0; i < 1000; ++i) x = std::sqrt(x * x + 1) / (x + 0.25f) + 0.5f;
    benchmark::DoNotOptimize(x);
  }
}
BENCHMARK(arithmetic);

/// Branches that nothing can predict, as descents of trees have them.
void branches(benchmark::State& state) {
  uint64_t bits = 0x9e3779b97f4a7c15;
  uint64_t left = 0, right = 1;
  for (auto _ : state) {
    for (int i = 0; i < 1000; ++i) {
      bits ^= bits << 13, bits ^= bits >> 7, bits ^= bits << 17;
      if (bits & 1) {
        left += bits % 7;
      } else {
        right ^= left;
      }
    }
    benchmark::DoNotOptimize(left + right);
  }
}
BENCHMARK(branches);

/// Reads from memory that each depend on the one before, over more than the caches hold.
void memory(benchmark::State& state) {
  constexpr size_t kEntries = size_t{1} << 22;
  std::vector<uint32_t> next(kEntries);
  // An odd step and an odd offset: a full cycle without a pattern that is fetched ahead.
  for (size_t i = 0; i < kEntries; ++i)
    next[i] = static_cast<uint32_t>((i * 1'664'525 + 1'013'904'223) % kEntries);
  uint32_t at = 0;
  for (auto _ : state) {
    for (int i = 0; i < 100; ++i) at = next[at];
    benchmark::DoNotOptimize(at);
  }
}
BENCHMARK(memory);

}  // namespace
