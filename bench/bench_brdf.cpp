// SPDX-License-Identifier: Apache-2.0
// Integrals of lobes over caps, and what BRDF-oriented light sampling costs a point.
#include <benchmark/benchmark.h>

#include <vector>

#include "core/hash.h"
#include "core/sampling.h"
#include "lightdistributions/brdf_cut.h"
#include "lightdistributions/brdf_pivot_table.h"

namespace lampyris {

namespace {

float uniform(uint64_t i, uint32_t d) { return toUnitFloat(hashCombine(i, d)); }

std::vector<DirectionCap> caps(bool clipped) {
  std::vector<DirectionCap> all;
  for (uint64_t i = 0; all.size() < 1024; ++i) {
    const Vec3 axis = sampleUniformSphere({uniform(i, 0), uniform(i, 1)});
    const DirectionCap cap(axis, sqr(0.7f * uniform(i, 2)));
    if (clipped ? std::abs(axis.z) < cap.sine : axis.z > cap.sine) all.push_back(cap);
  }
  return all;
}

void lobeOverCap(benchmark::State& state) {
  const auto all = caps(state.range(0));
  const Vec3 wo = normalize(Vec3(1, 0, 1));
  const PivotLobe lobe = reflectionLobe(wo, {0, 0, 1}, 0.1f, 1);
  size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(lobe.mean(all[i++ % all.size()]));
}
BENCHMARK(lobeOverCap)->ArgName("clipped")->Arg(0)->Arg(1);

void lobeOverEightCaps(benchmark::State& state) {
  const auto all = caps(state.range(0));
  std::vector<CapLanes> lanes;
  for (size_t i = 0; i < all.size(); i += Float8::size()) {
    const auto of = [&](const auto& value) {
      return Float8([&](auto k) { return value(all[i + k]); });
    };
    lanes.push_back(
        {of([](const auto& c) { return c.axis.x; }), of([](const auto& c) { return c.axis.y; }),
         of([](const auto& c) { return c.axis.z; }), of([](const auto& c) { return c.sine; }),
         of([](const auto& c) { return c.cosine(); }),
         of([](const auto& c) { return c.versine; })});
  }
  const PivotLobe lobe = reflectionLobe(normalize(Vec3(1, 0, 1)), {0, 0, 1}, 0.1f, 1);
  size_t i = 0;
  for (auto _ : state) {
    Float8 widest = 0;
    benchmark::DoNotOptimize(PivotLobeLanes::mean(lobe, lanes[i++ % lanes.size()], widest));
  }
}
BENCHMARK(lobeOverEightCaps)->ArgName("clipped")->Arg(0)->Arg(1);

void cosineOverCap(benchmark::State& state) {
  const auto all = caps(state.range(0));
  size_t i = 0;
  for (auto _ : state) {
    const DirectionCap& cap = all[i++ % all.size()];
    benchmark::DoNotOptimize(meanCosine(cap, cap.axis.z));
  }
}
BENCHMARK(cosineOverCap)->ArgName("clipped")->Arg(0)->Arg(1);

void lobeFromTable(benchmark::State& state) {
  const Vec3 wo = normalize(Vec3(1, 0, 1));
  float alpha = 0.01f;
  for (auto _ : state) {
    benchmark::DoNotOptimize(reflectionLobe(wo, {0, 0, 1}, alpha, 1));
    alpha = alpha < 1 ? alpha * 1.01f : 0.01f;
  }
}
BENCHMARK(lobeFromTable);

}  // namespace

}  // namespace lampyris
