// SPDX-License-Identifier: Apache-2.0
/// Rays through the scene's geometry: nearest hits, surfaces at them, and occlusion, among bumpy
/// meshes in a room and among instances of one.
#include <benchmark/benchmark.h>
#include <fmt/format.h>

#include <iterator>
#include <memory>
#include <vector>

#include "core/hash.h"
#include "core/sampling.h"
#include "scene/builder.h"

namespace lampyris {
namespace {

constexpr size_t kRays = 1 << 16;

float random(uint64_t index, uint32_t dimension) {
  return toUnitFloat(hashCombine(index, dimension));
}

/// A sphere with bumps, of 2 × n × n triangles.
std::string bumpyMesh(int n) {
  std::string text = "Shape \"trianglemesh\" \"point P\" [";
  for (int i = 0; i <= n; ++i)
    for (int j = 0; j <= n; ++j) {
      const float theta = kPi * static_cast<float>(i) / static_cast<float>(n);
      const float phi = 2 * kPi * static_cast<float>(j) / static_cast<float>(n);
      const float r = 0.5f + 0.05f * std::sin(9 * theta) * std::sin(7 * phi);
      fmt::format_to(std::back_inserter(text), "{:.5f} {:.5f} {:.5f}\n",
                     r * std::sin(theta) * std::cos(phi), r * std::sin(theta) * std::sin(phi),
                     r * std::cos(theta));
    }
  text += "] \"integer indices\" [";
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      const int a = i * (n + 1) + j, b = a + n + 1;
      fmt::format_to(std::back_inserter(text), "{} {} {} {} {} {}\n", a, b, b + 1, a, b + 1, a + 1);
    }
  return text + "]\n";
}

/// 27 meshes in a room of 6 × 6 × 6.
std::string makeScene(bool instances) {
  std::string text =
      "Camera \"perspective\"\nFilm \"image\" \"integer xresolution\" 1"
      " \"integer yresolution\" 1\nWorldBegin\n";
  const std::string mesh = bumpyMesh(40);
  if (instances) text += "ObjectBegin \"mesh\"\n" + mesh + "ObjectEnd\n";
  for (int i = 0; i < 27; ++i)
    text += fmt::format("AttributeBegin\nTranslate {} {} {}\n{}AttributeEnd\n", i % 3 * 2 - 2,
                        i / 3 % 3 * 2 - 2, i / 9 * 2 - 2,
                        instances ? "ObjectInstance \"mesh\"\n" : mesh);
  return text +
         "Shape \"trianglemesh\" \"point P\" [-3 -3 -3 3 -3 -3 -3 3 -3 3 3 -3 -3 -3 3 3 -3 3 -3 3 3"
         " 3 3 3] \"integer indices\" [0 1 2 1 3 2 4 6 5 5 6 7 0 4 1 1 4 5 2 3 6 3 7 6 0 2 4 2 6 4"
         " 1 5 3 3 5 7]\nWorldEnd\n";
}

struct World {
  SourceFiles files;
  Statistics statistics;
  Diagnostics diagnostics{files, [](const std::string&) {}};
  std::unique_ptr<RenderJob> job;
  std::vector<Ray> rays;
  std::vector<Ray> segments;  ///< between points in the room

  explicit World(bool instances) {
    job = loadSceneText(makeScene(instances), ".", {}, files, diagnostics, statistics);
    for (uint64_t i = 0; i < kRays; ++i) {
      const Vec3 from = Vec3(random(i, 0), random(i, 1), random(i, 2)) * 6.f - 3.f;
      const Vec3 to = Vec3(random(i, 5), random(i, 6), random(i, 7)) * 6.f - 3.f;
      rays.push_back({from, sampleUniformSphere({random(i, 3), random(i, 4)}), kInfinity, 0});
      segments.push_back({from, to - from, 0.9999f, 0});
    }
  }
  const Geometry& geometry() const { return *job->scene.geometry; }
};

const World& world(int64_t instances) {
  static const World meshes(false), objects(true);
  return instances ? objects : meshes;
}

void closest(benchmark::State& state) {
  const World& w = world(state.range(0));
  size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(w.geometry().intersect(w.rays[i++ % kRays]));
}

void occluded(benchmark::State& state) {
  const World& w = world(state.range(0));
  size_t i = 0;
  for (auto _ : state) benchmark::DoNotOptimize(w.geometry().occluded(w.segments[i++ % kRays]));
}

void surface(benchmark::State& state) {
  const World& w = world(state.range(0));
  std::vector<std::pair<Ray, Hit>> hits;
  for (const Ray& r : w.rays)
    if (const auto hit = w.geometry().intersect(r)) hits.emplace_back(r, *hit);
  size_t i = 0;
  for (auto _ : state) {
    const auto& [ray, hit] = hits[i++ % hits.size()];
    benchmark::DoNotOptimize(w.geometry().surface(ray, hit, SurfaceDetail::Basic));
  }
}

BENCHMARK(closest)->ArgName("instances")->Arg(0)->Arg(1);
BENCHMARK(occluded)->ArgName("instances")->Arg(0)->Arg(1);
BENCHMARK(surface)->ArgName("instances")->Arg(0)->Arg(1);

}  // namespace
}  // namespace lampyris
