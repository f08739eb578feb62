// SPDX-License-Identifier: Apache-2.0
/// Every registered material with its default parameters: making the BSDF at a point, drawing a
/// direction, and evaluating value and density for one.
#include <benchmark/benchmark.h>

#include <array>
#include <map>
#include <memory>

#include "base/bsdf.h"
#include "core/hash.h"
#include "core/sampling.h"
#include "materials/registry.h"
#include "scene/builder.h"

namespace lampyris {
namespace {

constexpr size_t kPoints = 64;

float random(uint64_t index, uint32_t dimension) {
  return toUnitFloat(hashCombine(index, dimension));
}

/// A sphere of the material, and points on it as camera rays find them.
struct Sample {
  SourceFiles files;
  Statistics statistics;
  Diagnostics diagnostics{files, [](const std::string&) {}};
  std::unique_ptr<RenderJob> job;
  std::array<SurfaceInteraction, kPoints> points;
  const Material* material = nullptr;

  explicit Sample(const std::string& name) {
    const std::string text =
        "Camera \"perspective\"\nFilm \"image\" \"integer xresolution\" 1"
        " \"integer yresolution\" 1\nWorldBegin\n"
        "MakeNamedMaterial \"a\" \"string type\" \"matte\"\n"
        "MakeNamedMaterial \"b\" \"string type\" \"plastic\"\nMaterial \"" +
        name + "\"" +
        (name == "mix" ? " \"string namedmaterial1\" \"a\" \"string namedmaterial2\" \"b\"" : "") +
        "\nShape \"sphere\"\nWorldEnd\n";
    job = loadSceneText(text, ".", {}, files, diagnostics, statistics);
    for (size_t i = 0; i < kPoints; ++i) {
      const Vec3 from = 5.f * sampleUniformSphere({random(i, 0), random(i, 1)});
      const Vec3 to = 0.9f * sampleUniformSphere({random(i, 2), random(i, 3)});
      const Ray ray{from, normalize(to - from), kInfinity, 0};
      const auto hit = job->scene.geometry->intersect(ray);
      points[i] = job->scene.geometry->surface(ray, *hit, SurfaceDetail::Full);
      material = job->scene.geometry->primitive(*hit).material;
    }
  }
};

Sample& sampleOf(const std::string& name) {
  static std::map<std::string, std::unique_ptr<Sample>> samples;
  auto& s = samples[name];
  if (!s) s = std::make_unique<Sample>(name);
  return *s;
}

void evaluate(benchmark::State& state, const std::string& name) {
  Sample& sample = sampleOf(name);
  Bsdf bsdf;
  size_t i = 0;
  for (auto _ : state) {
    SurfaceInteraction at = sample.points[i++ % kPoints];
    sample.material->evaluate(at, bsdf);
    benchmark::DoNotOptimize(bsdf.lobeCount());
  }
}

void draw(benchmark::State& state, const std::string& name) {
  Sample& sample = sampleOf(name);
  Bsdf bsdf;
  SurfaceInteraction at = sample.points[0];
  sample.material->evaluate(at, bsdf);
  uint64_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(bsdf.sample(at.wo, random(i, 0), {random(i, 1), random(i, 2)}));
    ++i;
  }
}

void value(benchmark::State& state, const std::string& name) {
  Sample& sample = sampleOf(name);
  Bsdf bsdf;
  SurfaceInteraction at = sample.points[0];
  sample.material->evaluate(at, bsdf);
  std::array<Vec3, kPoints> directions;
  for (size_t i = 0; i < kPoints; ++i)
    directions[i] = bsdf.frame().toWorld(sampleCosineHemisphere({random(i, 4), random(i, 5)}));
  size_t i = 0;
  for (auto _ : state) {
    const Vec3& wi = directions[i++ % kPoints];
    benchmark::DoNotOptimize(bsdf.f(at.wo, wi));
    benchmark::DoNotOptimize(bsdf.pdf(at.wo, wi));
  }
}

const bool kRegistered = [] {
  for (const auto& entry : materialRegistry().entries()) {
    const std::string& name = entry.name;
    benchmark::RegisterBenchmark((name + "/evaluate").c_str(), evaluate, name);
    benchmark::RegisterBenchmark((name + "/sample").c_str(), draw, name);
    benchmark::RegisterBenchmark((name + "/value").c_str(), value, name);
  }
  return true;
}();

}  // namespace
}  // namespace lampyris
