// SPDX-License-Identifier: Apache-2.0
/// The light BVH: build, sample and pmf over the number of lights.
#include <benchmark/benchmark.h>

#include <map>
#include <vector>

#include "accelerators/wide_light_bvh.h"
#include "core/hash.h"
#include "core/sampling.h"

namespace lampyris {
namespace {

enum Kind { kPoints, kTriangles };

float random(uint64_t index, uint32_t dimension) {
  return toUnitFloat(hashCombine(index, dimension));
}
Vec3 randomPoint(uint64_t index) {
  return Vec3(random(index, 0), random(index, 1), random(index, 2)) * 10.f;
}

/// Point lights, or small one-sided emitters, in a cube.
std::vector<LightBVHInput> makeLights(Kind kind, size_t count) {
  std::vector<LightBVHInput> lights(count);
  for (size_t i = 0; i < count; ++i) {
    LightBVHInput& l = lights[i];
    l.id = static_cast<LightId>(i);
    l.bounds.box = Bounds3(randomPoint(i));
    l.bounds.intensity = 0.1f + random(i, 3);
    if (kind == kPoints) continue;
    l.bounds.box.extend(l.bounds.box.min + 0.02f * randomPoint(i + count) / 10.f);
    l.bounds.axis = sampleUniformSphere({random(i, 4), random(i, 5)});
    l.bounds.cosThetaO = 1;
  }
  return lights;
}

LightSampleContext makePoint(uint64_t i) {
  LightSampleContext c;
  c.p = randomPoint(i + 0x123456789);
  c.n = c.ns = c.wo = sampleUniformSphere({random(i, 6), random(i, 7)});
  c.transmits = false;
  return c;
}

const LightBVHAccel& tree(Kind kind, size_t count) {
  static std::map<std::pair<Kind, size_t>, LightBVHAccel> trees;
  auto [it, fresh] = trees.try_emplace({kind, count});
  if (fresh) it->second = LightBVHAccel(makeLights(kind, count));
  return it->second;
}

const WideLightBVH& wideTree(Kind kind, size_t count) {
  static std::map<std::pair<Kind, size_t>, WideLightBVH> trees;
  auto [it, fresh] = trees.try_emplace({kind, count});
  if (fresh) it->second = WideLightBVH(tree(kind, count));
  return it->second;
}

void build(benchmark::State& state) {
  const auto lights =
      makeLights(static_cast<Kind>(state.range(0)), static_cast<size_t>(state.range(1)));
  LightBVHAccel::Stats stats;
  for (auto _ : state) {
    const LightBVHAccel built(lights);
    stats = built.stats();
    benchmark::DoNotOptimize(stats);
  }
  state.counters["depth"] = stats.depth;
  state.counters["bytes/light"] =
      static_cast<double>(stats.bytes) / static_cast<double>(stats.lights);
}

void sample(benchmark::State& state) {
  const LightBVHAccel& t =
      tree(static_cast<Kind>(state.range(0)), static_cast<size_t>(state.range(1)));
  uint64_t i = 0;
  for (auto _ : state) {
    const LightSampleContext c = makePoint(i);
    benchmark::DoNotOptimize(t.sample(LightReceiver(c), refineVariate(random(i, 8), c.p)));
    ++i;
  }
}

void pmf(benchmark::State& state) {
  const auto count = static_cast<size_t>(state.range(1));
  const LightBVHAccel& t = tree(static_cast<Kind>(state.range(0)), count);
  uint64_t i = 0;
  for (auto _ : state) {
    const auto light = static_cast<LightId>(random(i, 9) * static_cast<float>(count));
    benchmark::DoNotOptimize(t.pmf(LightReceiver(makePoint(i)), light));
    ++i;
  }
}

void collapse(benchmark::State& state) {
  const LightBVHAccel& binary =
      tree(static_cast<Kind>(state.range(0)), static_cast<size_t>(state.range(1)));
  WideLightBVH::Stats stats;
  for (auto _ : state) stats = WideLightBVH(binary).stats();
  state.counters["depth"] = stats.depth;
  state.counters["bytes/light"] =
      static_cast<double>(stats.bytes) / static_cast<double>(stats.lights);
}

void wideSample(benchmark::State& state) {
  const WideLightBVH& t =
      wideTree(static_cast<Kind>(state.range(0)), static_cast<size_t>(state.range(1)));
  uint64_t i = 0;
  for (auto _ : state) {
    const LightSampleContext c = makePoint(i);
    benchmark::DoNotOptimize(t.sample(LightReceiver(c), refineVariate(random(i, 8), c.p)));
    ++i;
  }
}

void widePmf(benchmark::State& state) {
  const auto count = static_cast<size_t>(state.range(1));
  const WideLightBVH& t = wideTree(static_cast<Kind>(state.range(0)), count);
  uint64_t i = 0;
  for (auto _ : state) {
    const auto light = static_cast<LightId>(random(i, 9) * static_cast<float>(count));
    benchmark::DoNotOptimize(t.pmf(LightReceiver(makePoint(i)), light));
    ++i;
  }
}

void sizes(benchmark::internal::Benchmark* b) {
  b->ArgNames({"kind", "lights"});
  for (const int64_t kind : {kPoints, kTriangles})
    for (const int64_t n : {100, 10'000, 1'000'000}) b->Args({kind, n});
}
BENCHMARK(build)
    ->Apply(sizes)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime()
    ->UseRealTime();
BENCHMARK(sample)->Apply(sizes);
BENCHMARK(pmf)->Apply(sizes);
BENCHMARK(collapse)->Apply(sizes)->Unit(benchmark::kMillisecond);
BENCHMARK(wideSample)->Apply(sizes);
BENCHMARK(widePmf)->Apply(sizes);

}  // namespace
}  // namespace lampyris
