// SPDX-License-Identifier: Apache-2.0
/// Arbitrary output variables (AOVs): layers of an image that explain it.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string_view>

#include "core/rgb.h"
#include "core/vector.h"

namespace lampyris {

enum class Aov : uint8_t {
  Albedo,
  Normal,
  Depth,
  SampleCount,
  Variance,
  LightCut,
  BsdfShare,
  BrdfSamples,
  BsdfDraws,
  LightEntropy,
  PathLength,
  Time
};
/// As the command line and scene files spell them, in the order of the enumeration.
inline constexpr std::array<std::string_view, 12> kAovNames = {
    "albedo",    "normal",      "depth",     "samplecount",  "variance",   "lightcut",
    "bsdfshare", "brdfsamples", "bsdfdraws", "lightentropy", "pathlength", "time"};

class AovSet {
 public:
  AovSet() = default;
  explicit AovSet(uint32_t bits) : bits_(bits) {}
  void add(Aov a) { bits_ |= bit(a); }
  bool has(Aov a) const { return bits_ & bit(a); }
  bool empty() const { return bits_ == 0; }
  uint32_t bits() const { return bits_; }

 private:
  static uint32_t bit(Aov a) { return uint32_t{1} << static_cast<uint8_t>(a); }
  uint32_t bits_ = 0;
};

/// What one camera path tells for the AOVs. Integrators fill it only where one is asked for. "The
/// light vertex" is the first vertex of the path at which lights are sampled.
class AovRecord {
 public:
  /// The first surface that is shaded. `weight`: f |cos θ| / pdf of a BSDF sample, whose mean is
  /// the albedo; `n` unit.
  void surface(const Vec3& p, const Vec3& n, const Rgb& weight) {
    seen = true;
    normal = n;
    albedo = weight;
    depth = distance(cameraPoint, p);
  }
  /// Opens the path's next light vertex; what follows counts for the first one only.
  void beginLightVertex() { ++lightVertices_; }
  /// A light was drawn, with this probability or expected count.
  void lightDraw(float pmf) {
    if (!atFirst() || !(pmf > 0)) return;
    ++draws;
    information += std::max(0., -std::log2(static_cast<double>(pmf)));
  }
  /// Direct light that light sampling, and BSDF sampling, contributed to the path's radiance.
  void lightSampled(const Rgb& light) {
    if (atFirst()) lightPart += static_cast<double>(light.luminance());
  }
  void bsdfSampled(const Rgb& light) {
    if (atFirst()) bsdfPart += static_cast<double>(light.luminance());
  }
  /// Adaptive direct lighting took so many BRDF-aware samples, of which so many were of the BSDF.
  void brdfAware(int samples, int ofBsdf) {
    if (!atFirst()) return;
    brdfSamples = static_cast<uint32_t>(samples);
    bsdfDraws = static_cast<uint32_t>(ofBsdf);
  }

  bool hasLightVertex() const { return lightVertices_ > 0; }

  Vec3 cameraPoint{0};  ///< where the camera's ray begins
  bool seen = false;
  Rgb albedo;
  Vec3 normal{0};
  float depth = 0;
  uint32_t draws = 0;      ///< lights drawn at the light vertex
  double information = 0;  ///< Σ −log₂ pmf over the draws, in bits
  double lightPart = 0, bsdfPart = 0;
  uint32_t brdfSamples = 0, bsdfDraws = 0;
  uint64_t segments = 0;  ///< closest-hit rays of the path
  double seconds = 0;

 private:
  bool atFirst() const { return lightVertices_ == 1; }
  uint32_t lightVertices_ = 0;
};

}  // namespace lampyris
