// SPDX-License-Identifier: Apache-2.0
/// Drawing a point of an emitting triangle: time a sample and relative variance of the irradiance
/// that it estimates, for receivers in front of it in random places and orientations. The argument
/// is their distance from the centroid in hundredths of the two edges' length.
#include <benchmark/benchmark.h>

#include <vector>

#include "core/frame.h"
#include "core/hash.h"
#include "core/sampling.h"
#include "shapes/triangle_mesh.h"

namespace lampyris {
namespace {

enum class Way { Area, Shape };  ///< uniform by area, or as the shape does it

const TriangleMesh& emitter() {
  static const TriangleMesh mesh({{0, 1, 2}, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {}, {}, {}}, {},
                                 false);
  return mesh;
}

template <Way way>
std::optional<ShapeSample> draw(const Vec3& from, const Vec2& u) {
  return way == Way::Shape ? emitter().sampleSolidAngle(0, from, u)
                           : emitter().Shape::sampleSolidAngle(0, from, u);
}

float random(uint64_t index, uint32_t dimension) {
  return toUnitFloat(hashCombine(index, dimension));
}
Vec2 random2(uint64_t index, uint32_t dimension) {
  return {random(index, dimension), random(index, dimension + 1)};
}

struct Receiver {
  Vec3 p, n;
};

std::vector<Receiver> receivers(float distance) {
  std::vector<Receiver> all;
  const Vec3 centroid(1.f / 3, 1.f / 3, 0);
  for (uint64_t i = 0; i < 1000; ++i) {
    const Vec3 away = sampleCosineHemisphere(random2(i, 0));
    const Vec3 facing = Frame::fromZ(-away).toWorld(sampleCosineHemisphere(random2(i, 2)));
    all.push_back({centroid + distance * away, facing});
  }
  return all;
}

/// Variance over all receivers in relation to the sum of their squared means.
template <Way way>
double relativeVariance(const std::vector<Receiver>& all) {
  constexpr int kSamples = 256;
  double variance = 0, square = 0;
  for (uint64_t i = 0; i < all.size(); ++i) {
    double sum = 0, sum2 = 0;
    for (uint64_t k = 0; k < kSamples; ++k) {
      const auto s = draw<way>(all[i].p, random2(i * kSamples + k, 4));
      const float cosine = s ? dot(normalize(s->p - all[i].p), all[i].n) : 0;
      const double f = cosine > 0 ? static_cast<double>(cosine / s->pdf) : 0;
      sum += f;
      sum2 += f * f;
    }
    const double mean = sum / kSamples;
    variance += sum2 / kSamples - mean * mean;
    square += mean * mean;
  }
  return variance / square;
}

template <Way way>
void sampleTriangle(benchmark::State& state) {
  const auto all = receivers(static_cast<float>(state.range(0)) / 100);
  uint64_t i = 0;
  for (auto _ : state) {
    ++i;
    benchmark::DoNotOptimize(draw<way>(all[i % all.size()].p, random2(i, 4)));
  }
  state.counters["variance"] = relativeVariance<way>(all);
}

void pdfTriangle(benchmark::State& state) {
  const auto all = receivers(static_cast<float>(state.range(0)) / 100);
  uint64_t i = 0;
  for (auto _ : state)
    benchmark::DoNotOptimize(
        emitter().pdfSolidAngle(0, all[++i % all.size()].p, {0.3f, 0.3f, 0}, {0, 0, 1}));
}

#define DISTANCES ->Arg(5)->Arg(20)->Arg(50)->Arg(100)->Arg(200)->Arg(400)->Arg(1000)
BENCHMARK(sampleTriangle<Way::Area>) DISTANCES;
BENCHMARK(sampleTriangle<Way::Shape>) DISTANCES;
BENCHMARK(pdfTriangle)->Arg(20)->Arg(1000);

}  // namespace
}  // namespace lampyris
