// SPDX-License-Identifier: Apache-2.0
/// Gradient noise (Perlin 2002, "Improving Noise") and sums of its octaves (Ebert et al. 2003,
/// "Texturing and Modeling", chapter 2), with the constants of pbrt-v3.
#pragma once

#include "core/vector.h"
#include "textures/texture_mapping.h"

namespace lampyris {

/// Noise in about [−1, 1], 0 at all points with integer coordinates, of period 256 along each axis.
/// 0 where `p` is not finite.
float perlinNoise(const Vec3& p);

/// How octaves are summed: octave i has 1.99^i times the frequency and roughness^i times the
/// amplitude.
struct Octaves {
  int count = 8;
  float roughness = 0.5f;
};
/// The most octaves: later ones have frequencies beyond the range of floats.
inline constexpr int kMostOctaves = 128;

/// Fractional Brownian motion. Octaves finer than the footprint are left out, the last one fades.
float fractalNoise(const TexturePoint& at, const Octaves& octaves);
/// The sum of absolute values; 0.2, about their mean, stands for octaves that are left out. As in
/// pbrt-v3 the octave that fades counts among those, too.
float turbulence(const TexturePoint& at, const Octaves& octaves);

}  // namespace lampyris
