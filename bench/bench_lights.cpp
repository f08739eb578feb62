// SPDX-License-Identifier: Apache-2.0
/// The light BVH in both its forms: build, sample, pmf and cut over the number of lights, and how
/// noisy one sample is for each kind of importance factors.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include "accelerators/wide_light_bvh.h"
#include "core/hash.h"
#include "core/sampling.h"

namespace lampyris {
namespace {

enum Kind { kPoints, kTriangles };
using Lights = std::vector<LightBVHInput>;

float random(uint64_t index, uint32_t dimension) {
  return toUnitFloat(hashCombine(index, dimension));
}
Vec3 randomPoint(uint64_t index) {
  return Vec3(random(index, 0), random(index, 1), random(index, 2)) * 10.f;
}

/// Point lights, or small one-sided emitters, in a cube.
Lights makeLights(Kind kind, size_t count) {
  Lights lights(count);
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
  static const Bsdf surface{};
  LightSampleContext c;
  c.p = randomPoint(i + 0x123456789);
  c.n = c.ns = c.wo = sampleUniformSphere({random(i, 6), random(i, 7)});
  c.transmits = false;
  c.bsdf = &surface;
  return c;
}

/// The last tree asked for is kept: a benchmark function runs several times.
template <class Tree>
const Tree& treeOf(Kind kind, size_t count) {
  static std::pair<Kind, size_t> made;
  static std::optional<Tree> tree;
  if (!tree || made != std::pair(kind, count)) {
    tree.emplace(LightBVHAccel(makeLights(kind, count)));
    made = {kind, count};
  }
  return *tree;
}

Kind kindOf(const benchmark::State& state) { return static_cast<Kind>(state.range(0)); }
size_t countOf(const benchmark::State& state) { return static_cast<size_t>(state.range(1)); }

/// The binary tree from its lights, or the wide one from the binary one.
template <class Tree>
void build(benchmark::State& state) {
  const Lights lights = makeLights(kindOf(state), countOf(state));
  std::optional<LightBVHAccel> binary;
  if constexpr (std::is_same_v<Tree, WideLightBVH>) binary.emplace(lights);
  typename Tree::Stats stats;
  for (auto _ : state) {
    if constexpr (std::is_same_v<Tree, WideLightBVH>) {
      stats = Tree(*binary).stats();
    } else {
      stats = Tree(lights).stats();
    }
    benchmark::DoNotOptimize(stats);
  }
  state.counters["depth"] = stats.depth;
  state.counters["bytes/light"] =
      static_cast<double>(stats.bytes) / static_cast<double>(stats.lights);
}

template <class Tree>
void sample(benchmark::State& state) {
  const Tree& tree = treeOf<Tree>(kindOf(state), countOf(state));
  uint64_t i = 0;
  for (auto _ : state) {
    const LightSampleContext c = makePoint(i);
    benchmark::DoNotOptimize(tree.sample(LightReceiver(c), refineVariate(random(i, 8), c.p)));
    ++i;
  }
}

template <class Tree>
void pmf(benchmark::State& state) {
  const size_t count = countOf(state);
  const Tree& tree = treeOf<Tree>(kindOf(state), count);
  uint64_t i = 0;
  for (auto _ : state) {
    const auto light = static_cast<LightId>(random(i, 9) * static_cast<float>(count));
    benchmark::DoNotOptimize(tree.pmf(LightReceiver(makePoint(i)), light));
    ++i;
  }
}

void cut(benchmark::State& state) {
  const WideLightBVH& tree = treeOf<WideLightBVH>(kindOf(state), countOf(state));
  const LightSplitting splitting(0.3f, static_cast<uint32_t>(state.range(2)));
  SampledLights drawn;
  uint64_t i = 0;
  size_t total = 0;
  for (auto _ : state) {
    const LightSampleContext c = makePoint(i);
    drawn.clear();
    tree.sampleCut(LightReceiver(c), refineVariate(random(i, 8), c.p), splitting, drawn);
    total += drawn.size();
    ++i;
  }
  state.counters["lights/cut"] = static_cast<double>(total) / static_cast<double>(i);
}

/// Irradiance, without visibility, from the middle of a light's box.
double irradiance(const LightBVHInput& light, const LightSampleContext& c, Kind kind) {
  const Vec3 d = light.bounds.box.centroid() - c.p;
  const float d2 = dot(d, d);
  const Vec3 w = d / std::sqrt(d2);
  const float emission = kind == kPoints ? 1.f : std::max(0.f, -dot(w, light.bounds.axis));
  return static_cast<double>(light.bounds.intensity * emission * std::max(0.f, dot(w, c.n)) / d2);
}

/// Variance of the irradiance by one sample, relative to its square: Σ e²/pmf / (Σ e)² − 1, without
/// drawing. Deterministic. The median and the mean over opaque points of a grid of places.
template <class Tree, LightFactors kFactors>
void noise(benchmark::State& state) {
  const Kind kind = kindOf(state);
  const Lights lights = makeLights(kind, countOf(state));
  const Tree& tree = treeOf<Tree>(kind, countOf(state));
  std::vector<double> each;
  for (auto _ : state) {
    each.clear();
    for (uint64_t i = 0; i < 400; ++i) {
      LightSampleContext c = makePoint(i);
      c.p = c.p * 1.6f - 3.f;
      const LightReceiver at(c, kFactors);
      double sum = 0, squares = 0;
      for (const LightBVHInput& l : lights) {
        const double e = irradiance(l, c, kind);
        if (!(e > 0)) continue;
        sum += e;
        squares += e * e / static_cast<double>(tree.pmf(at, l.id));
      }
      if (sum > 0) each.push_back(squares / (sum * sum) - 1);
    }
  }
  std::sort(each.begin(), each.end());
  double mean = 0;
  for (const double v : each) mean += v / static_cast<double>(each.size());
  state.counters["median"] = each[each.size() / 2];
  state.counters["mean"] = mean;
}

void sizes(benchmark::internal::Benchmark* b) {
  b->ArgNames({"kind", "lights"});
  for (const int64_t kind : {kPoints, kTriangles})
    for (const int64_t n : {100, 10'000, 1'000'000}) b->Args({kind, n});
}
/// Also ten million.
void buildSizes(benchmark::internal::Benchmark* b) {
  sizes(b);
  b->Args({kPoints, 10'000'000})->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime();
  b->UseRealTime();
}
void cutSizes(benchmark::internal::Benchmark* b) {
  b->ArgNames({"kind", "lights", "maxcut"});
  for (const int64_t n : {100, 10'000, 1'000'000})
    for (const int64_t maxCut : {1, 8, 64}) b->Args({kPoints, n, maxCut});
}
void noiseSizes(benchmark::internal::Benchmark* b) {
  b->ArgNames({"kind", "lights"})->Iterations(1)->Unit(benchmark::kMillisecond);
  for (const int64_t kind : {kPoints, kTriangles})
    for (const int64_t n : {100, 1000}) b->Args({kind, n});
}

BENCHMARK(build<LightBVHAccel>)->Apply(buildSizes);
BENCHMARK(build<WideLightBVH>)->Apply(buildSizes);
BENCHMARK(sample<LightBVHAccel>)->Apply(sizes);
BENCHMARK(sample<WideLightBVH>)->Apply(sizes);
BENCHMARK(pmf<LightBVHAccel>)->Apply(sizes);
BENCHMARK(pmf<WideLightBVH>)->Apply(sizes);
BENCHMARK(cut)->Apply(cutSizes);
BENCHMARK_TEMPLATE(noise, WideLightBVH, LightFactors::Mean)->Apply(noiseSizes);
BENCHMARK_TEMPLATE(noise, LightBVHAccel, LightFactors::Mean)->Apply(noiseSizes);
BENCHMARK_TEMPLATE(noise, LightBVHAccel, LightFactors::Bound)->Apply(noiseSizes);
BENCHMARK_TEMPLATE(noise, LightBVHAccel, LightFactors::Thesis)->Apply(noiseSizes);

}  // namespace
}  // namespace lampyris
