// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "core/bounds.h"
#include "core/sampling.h"
#include "media/density_grid.h"
#include "media/registry.h"
#include "support/statistics.h"

namespace lampyris::test {

namespace {

std::vector<float> cloud(int nx, int ny, int nz) {
  std::vector<float> values;
  for (int i = 0; i < nx * ny * nz; ++i) {
    const float u = uniform(5, static_cast<uint64_t>(i), 0);
    values.push_back(u < 0.4f ? 0 : u);
  }
  return values;
}

Ray rayThroughCube(uint64_t i) {
  Ray ray;
  ray.o = Vec3(0.5f) + 2.f * sampleUniformSphere({uniform(1, i, 0), uniform(1, i, 1)});
  const Vec3 target(uniform(1, i, 2), uniform(1, i, 3), uniform(1, i, 4));
  ray.d = normalize(target - ray.o);
  return ray;
}

TEST(DensityGrid, InterpolatesBetweenCentres) {
  const DensityGrid grid(2, 1, 1, {1, 3}, 16);
  EXPECT_FLOAT_EQ(grid.density(Vec3(0.25f, 0.5f, 0.5f)), 1);
  EXPECT_FLOAT_EQ(grid.density(Vec3(0.5f, 0.5f, 0.5f)), 2);
  EXPECT_FLOAT_EQ(grid.density(Vec3(0.25f, 0.5f, 0)), 0.5f);  // half way to nothing
}

TEST(DensityGrid, BoundsHoldAlongRays) {
  for (const int n : {1, 3, 16, 37}) {
    const DensityGrid grid(n, n + 1, 2 * n, cloud(n, n + 1, 2 * n), n == 3 ? 5 : 16);
    for (uint64_t i = 0; i < 200; ++i) {
      Ray ray = rayThroughCube(i);
      if (i % 4 == 0) ray.d = Vec3(0, 0, ray.o.z > 0.5f ? -1 : 1), ray.o.x = ray.o.y = 0.3f;
      float at = -1, covered = 0;
      grid.track(ray, [&](float t0, float t1, float bound) {
        EXPECT_LE(t0, t1);
        EXPECT_GE(t0, at);
        at = t1;
        covered += t1 - t0;
        for (const float u : {0.01f, 0.3f, 0.77f, 0.99f})
          EXPECT_LE(grid.density(ray.at(lerp(u, t0, t1))), bound * 1.00001f);
        return true;
      });
      EXPECT_GT(covered, 0);
      EXPECT_LE(covered, 1.7322f);
    }
  }
}

std::unique_ptr<Medium> make(const std::vector<float>& density, std::array<int32_t, 3> n,
                             std::array<float, 3> absorption, std::array<float, 3> scattering,
                             int32_t boundCells = 16) {
  std::vector<Parameter> parameters;
  const auto add = [&](std::string_view name, ParameterType type) -> Parameter& {
    Parameter& p = parameters.emplace_back();
    p.name = name;
    p.type = type;
    return p;
  };
  add("density", ParameterType::Float).floats = density;
  add("sigma_a", ParameterType::Rgb).floats = absorption;
  add("sigma_s", ParameterType::Rgb).floats = scattering;
  add("nx", ParameterType::Integer).integers = std::span(&n[0], 1);
  add("ny", ParameterType::Integer).integers = std::span(&n[1], 1);
  add("nz", ParameterType::Integer).integers = std::span(&n[2], 1);
  add("boundcells", ParameterType::Integer).integers = std::span(&boundCells, 1);
  SourceFiles files;
  Diagnostics diagnostics(files, [](const std::string&) {});
  return mediumRegistry()
      .get("heterogeneous", {})
      .create({parameters, {}}, {{diagnostics, [](const std::string& s) { return s; }, {}}, {}});
}

TEST(Heterogeneous, TrackingAgreesWithQuadrature) {
  const auto values = cloud(6, 5, 4);
  const DensityGrid grid(6, 5, 4, values, 16);
  TrackingCounts counts;
  for (uint64_t r = 0; r < 5; ++r) {
    const auto medium = make(values, {6, 5, 4}, {0.5f, 0, 1}, {4, 1, 0.5f}, r == 1 ? 1 : 16);
    const Ray ray = rayThroughCube(r);
    double depth = 0;
    for (int i = 0; i < 40'000; ++i) {
      const Vec3 p = ray.at(4 * (static_cast<float>(i) + 0.5f) / 40'000);
      if (Bounds3(Vec3(0), Vec3(1)).contains(p))
        depth += static_cast<double>(grid.density(p)) * 4 / 40'000;
    }
    std::vector<double> red, green, through, scattered;
    for (uint64_t i = 0; i < 20'000; ++i) {
      NumberSequence a(mixBits(2 * i + 1)), b(mixBits(2 * i + 2));
      const Rgb t = medium->transmittance(ray, a, counts);
      red.push_back(static_cast<double>(t.r));
      green.push_back(static_cast<double>(t.g));
      const MediumSample s = medium->sample(ray, b, counts);
      ASSERT_TRUE(s.weight.isFinite());
      through.push_back(s.scatters ? 0 : static_cast<double>(s.weight.g));
      scattered.push_back(s.scatters ? static_cast<double>(s.weight.r) : 0);
    }
    EXPECT_EQ(meanTest(red, std::exp(-4.5 * depth), 1e-3), "") << r;
    EXPECT_EQ(meanTest(green, std::exp(-depth), 1e-3), "") << r;
    EXPECT_EQ(meanTest(through, std::exp(-depth), 1e-3), "") << r;
    EXPECT_EQ(meanTest(scattered, 4 / 4.5 * (1 - std::exp(-4.5 * depth)), 1e-3), "") << r;
  }
}

TEST(Heterogeneous, StepsAreAsManyAsTheBoundsAllow) {
  // One of 16³ cells is full. A ray along it: σ steps a unit of length where its bound is.
  constexpr int kSide = 16;
  std::vector<float> values(kSide * kSide * kSide, 0.f);
  values[(8 * kSide + 8) * kSide + 8] = 1;
  const auto stepsPerRay = [&](int32_t boundCells) {
    const auto medium = make(values, {kSide, kSide, kSide}, {0, 0, 0}, {40, 40, 40}, boundCells);
    Ray ray;
    ray.o = Vec3(-1, 9.4f / kSide, 9.4f / kSide);
    ray.d = Vec3(1, 0, 0);
    ray.tMax = 3;
    std::vector<double> steps;
    for (uint64_t i = 0; i < 4000; ++i) {
      TrackingCounts counts;
      NumberSequence numbers(mixBits(i));
      medium->transmittance(ray, numbers, counts);
      steps.push_back(static_cast<double>(counts.steps));
    }
    return steps;
  };
  // The density there is a hundredth of the bound at most: roulette ends no ray.
  EXPECT_EQ(meanTest(stepsPerRay(1), 40), "");
  EXPECT_EQ(meanTest(stepsPerRay(16), 40. * 3 / 16), "");
}

TEST(Heterogeneous, Mistakes) {
  EXPECT_THROW(make({1, 2}, {2, 2, 2}, {1, 1, 1}, {1, 1, 1}), SceneError);
  EXPECT_THROW(make({1, -2}, {2, 1, 1}, {1, 1, 1}, {1, 1, 1}), SceneError);
  EXPECT_THROW(make({1}, {-1, 1, -1}, {1, 1, 1}, {1, 1, 1}), SceneError);
  // Empty space lets everything through.
  const auto empty = make({0, 0}, {2, 1, 1}, {1, 1, 1}, {1, 1, 1});
  NumberSequence numbers(1);
  TrackingCounts counts;
  EXPECT_EQ(empty->transmittance(rayThroughCube(1), numbers, counts), Rgb(1));
  EXPECT_EQ(counts.rays, 1u);
  EXPECT_EQ(counts.steps, 0u);
}

}  // namespace

}  // namespace lampyris::test
