// SPDX-License-Identifier: Apache-2.0
/// Tracking through a cloud, with and without the grid of bounds that lets rays pass empty space.
#include <benchmark/benchmark.h>

#include <cmath>
#include <map>
#include <vector>

#include "core/hash.h"
#include "core/sampling.h"
#include "media/registry.h"

namespace lampyris {
namespace {

constexpr int kSide = 256;

float random(uint64_t index, uint32_t dimension) {
  return toUnitFloat(hashCombine(index, dimension));
}

/// Balls of smooth density, of which 95 % of the cells have none.
const std::vector<float>& cloud() {
  static const std::vector<float> values = [] {
    std::vector<float> v(static_cast<size_t>(kSide) * kSide * kSide, 0.f);
    size_t full = 0;
    for (uint64_t ball = 0; full < v.size() / 20; ++ball) {
      const Vec3 centre = (0.1f + 0.8f * Vec3(random(ball, 0), random(ball, 1), random(ball, 2))) *
                          static_cast<float>(kSide);
      const float radius = static_cast<float>(kSide) * (0.03f + 0.07f * random(ball, 3));
      const Int2 zRange(static_cast<int>(centre.z - radius), static_cast<int>(centre.z + radius));
      for (int z = std::max(0, zRange.x); z <= std::min(kSide - 1, zRange.y); ++z)
        for (int y = 0; y < kSide; ++y)
          for (int x = 0; x < kSide; ++x) {
            const float d = length(Vec3(x, y, z) - centre) / radius;
            if (d >= 1) continue;
            float& to = v[(static_cast<size_t>(z) * kSide + static_cast<size_t>(y)) * kSide +
                          static_cast<size_t>(x)];
            full += to == 0 ? 1 : 0;
            to = std::max(to, 1 - d * d);
          }
    }
    return v;
  }();
  return values;
}

std::unique_ptr<Medium> makeCloud(int32_t boundCells) {
  static const int32_t side = kSide;
  static const float none[] = {0, 0, 0}, scattering[] = {60, 60, 60};
  std::vector<Parameter> p;
  const auto add = [&p](std::string_view name, ParameterType type) -> Parameter& {
    p.push_back({name, {}, type});
    return p.back();
  };
  add("density", ParameterType::Float).floats = cloud();
  add("sigma_a", ParameterType::Rgb).floats = none;
  add("sigma_s", ParameterType::Rgb).floats = scattering;
  for (const char* n : {"nx", "ny", "nz"}) add(n, ParameterType::Integer).integers = {&side, 1};
  add("boundcells", ParameterType::Integer).integers = {&boundCells, 1};
  SourceFiles files;
  Diagnostics diagnostics(files, [](const std::string&) {});
  return mediumRegistry()
      .get("heterogeneous", {})
      .create({p, {}}, {{diagnostics, [](const std::string& s) { return s; }, {}}, {}});
}

const Medium& cloudOf(int32_t boundCells) {
  static std::map<int32_t, std::unique_ptr<Medium>> made;
  auto& medium = made[boundCells];
  if (!medium) medium = makeCloud(boundCells);
  return *medium;
}

/// Between random points of two spheres around the cube.
Ray makeRay(uint64_t i) {
  const auto point = [i](uint32_t d) {
    return Vec3(0.5f) + 0.87f * sampleUniformSphere({random(i, d), random(i, d + 1)});
  };
  Ray ray;
  const Vec3 from = point(10), to = point(12);
  ray.o = from;
  ray.d = normalize(to - from);
  ray.tMax = length(to - from);
  return ray;
}

template <class F>
void run(benchmark::State& state, F&& follow) {
  const Medium& medium = cloudOf(static_cast<int32_t>(state.range(0)));
  std::vector<Ray> rays;
  for (uint64_t i = 0; i < 4096; ++i) rays.push_back(makeRay(i));
  TrackingCounts counts;
  uint64_t i = 0;
  for (auto _ : state) {
    NumberSequence numbers(mixBits(++i));
    follow(medium, rays[i % rays.size()], numbers, counts);
  }
  state.counters["steps"] = static_cast<double>(counts.steps) / static_cast<double>(counts.rays);
}

void distance(benchmark::State& state) {
  run(state, [](const Medium& m, const Ray& ray, NumberSequence& numbers, TrackingCounts& counts) {
    benchmark::DoNotOptimize(m.sample(ray, numbers, counts));
  });
}
void transmittance(benchmark::State& state) {
  run(state, [](const Medium& m, const Ray& ray, NumberSequence& numbers, TrackingCounts& counts) {
    benchmark::DoNotOptimize(m.transmittance(ray, numbers, counts));
  });
}
BENCHMARK(distance)->Arg(1)->Arg(8)->Arg(16)->Arg(32)->Arg(64);
BENCHMARK(transmittance)->Arg(1)->Arg(8)->Arg(16)->Arg(32)->Arg(64);

}  // namespace
}  // namespace lampyris
