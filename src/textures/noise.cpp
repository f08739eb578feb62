// SPDX-License-Identifier: Apache-2.0
#include "textures/noise.h"

#include <cmath>
#include <cstdint>

#include "textures/perlin_permutation.h"

namespace lampyris {

namespace {

/// Towards the middles of a cube's edges, four of them twice; which four is pbrt-v3's choice, and
/// not that of Perlin's reference.
constexpr float kGradients[16][3] = {
    {1, 1, 0}, {-1, 1, 0}, {1, -1, 0}, {-1, -1, 0}, {1, 0, 1}, {-1, 0, 1}, {1, 0, -1}, {-1, 0, -1},
    {0, 1, 1}, {0, -1, 1}, {0, 1, -1}, {0, -1, -1}, {1, 1, 0}, {-1, 1, 0}, {0, 1, -1}, {0, -1, -1}};

uint32_t permuted(uint32_t i) { return kPerlinPermutation[i & 255]; }

/// One coordinate: its cell modulo the period, where in the cell, and the weight of the far end.
struct Axis {
  explicit Axis(float x) {
    const float floor = std::floor(x);
    cell = static_cast<uint32_t>(floor - 256 * std::floor(floor / 256));
    offset = x - floor;
    weight = offset * offset * offset * (offset * (offset * 6 - 15) + 10);
  }
  uint32_t cell;
  float offset, weight;
};

/// Octaves that a footprint leaves: up to `count`, not whole.
float visibleOctaves(const TexturePoint& at, int count) {
  const float width2 = std::max(lengthSquared(at.dpdx), lengthSquared(at.dpdy));
  if (!(width2 > 0)) return static_cast<float>(count);
  return std::clamp(-1 - 0.5f * std::log2(width2), 0.f, static_cast<float>(count));
}

float smoothStep(float from, float to, float x) {
  const float t = std::clamp((x - from) / (to - from), 0.f, 1.f);
  return t * t * (3 - 2 * t);
}

/// Calls add(amplitude, noise, presence) for each visible octave; returns their number, and in
/// `amplitude` that of the next one.
template <class Add>
int forEachOctave(const TexturePoint& at, const Octaves& octaves, float& amplitude, Add add) {
  constexpr float kLacunarity = 1.99f;
  const float visible = visibleOctaves(at, octaves.count);
  const int whole = static_cast<int>(visible);
  float frequency = 1;
  amplitude = 1;
  for (int i = 0; i < whole; ++i) {
    add(amplitude, perlinNoise(frequency * at.p), 1.f);
    frequency *= kLacunarity;
    amplitude *= octaves.roughness;
  }
  add(amplitude, perlinNoise(frequency * at.p),
      smoothStep(0.3f, 0.7f, visible - static_cast<float>(whole)));
  return whole;
}

}  // namespace

float perlinNoise(const Vec3& p) {
  if (!isFinite(p)) return 0;
  const Axis x(p.x), y(p.y), z(p.z);
  const auto corner = [&](uint32_t i, uint32_t j, uint32_t k) {
    const uint32_t hash = permuted(permuted(permuted(x.cell + i) + y.cell + j) + z.cell + k);
    const float* const g = kGradients[hash & 15];
    return g[0] * (x.offset - static_cast<float>(i)) + g[1] * (y.offset - static_cast<float>(j)) +
           g[2] * (z.offset - static_cast<float>(k));
  };
  const auto edge = [&](uint32_t j, uint32_t k) {
    return lerp(x.weight, corner(0, j, k), corner(1, j, k));
  };
  const auto face = [&](uint32_t k) { return lerp(y.weight, edge(0, k), edge(1, k)); };
  return lerp(z.weight, face(0), face(1));
}

float fractalNoise(const TexturePoint& at, const Octaves& octaves) {
  float sum = 0, amplitude;
  forEachOctave(at, octaves, amplitude, [&sum](float weight, float noise, float presence) {
    sum += weight * presence * noise;
  });
  return sum;
}

float turbulence(const TexturePoint& at, const Octaves& octaves) {
  constexpr float kMean = 0.2f;
  float sum = 0, amplitude;
  const int whole =
      forEachOctave(at, octaves, amplitude, [&sum](float weight, float noise, float presence) {
        sum += weight * lerp(presence, kMean, std::abs(noise));
      });
  for (int i = whole; i < octaves.count; ++i) {
    sum += kMean * amplitude;
    amplitude *= octaves.roughness;
  }
  return sum;
}

}  // namespace lampyris
