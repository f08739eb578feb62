// SPDX-License-Identifier: Apache-2.0
/// What a cluster of lights costs by the surface area orientation heuristic: Ma 2018, eq. 3.1–3.6.
/// Deviations: light_bvh_builder.h.
#pragma once

#include <bit>
#include <cstdint>

#include "base/light.h"

namespace lampyris {

// Four floats in a register: the compiler's vectors, since the build is bound by a few minima,
// maxima and sums.
using Float4 = float __attribute__((vector_size(16)));
using Int4 = int32_t __attribute__((vector_size(16)));
inline Float4 min4(Float4 a, Float4 b) { return a < b ? a : b; }
inline Float4 max4(Float4 a, Float4 b) { return a > b ? a : b; }
inline Float4 splat(float v) { return Float4{v, v, v, v}; }

/// A light while the tree is built.
struct BuildLight {
  Float4 lo;      ///< of the box; last: cos θe
  Float4 hi;      ///< of the box; last: `index` in its bits, made a normal float by kIndexBit
  Float4 spread;  ///< intensity × axis × how far normals agree; last: intensity
  static constexpr uint32_t kIndexBit = 0x40000000;

  /// Without values: an array of them is filled in by several threads.
  BuildLight() = default;
  /// `index` < 2³⁰.
  BuildLight(const LightBounds& bounds, uint32_t index);

  uint32_t index() const { return std::bit_cast<uint32_t>(hi[3]) & ~kIndexBit; }
  Float4 twiceCentroid() const { return lo + hi; }
};

/// What the heuristic wants to know of a set of lights.
struct Bucket {
  Float4 lo = splat(kInfinity), hi = splat(-kInfinity), spread = splat(0);

  void add(const BuildLight& l) { lo = min4(lo, l.lo), hi = max4(hi, l.hi), spread += l.spread; }
  void add(const Bucket& b) { lo = min4(lo, b.lo), hi = max4(hi, b.hi), spread += b.spread; }
  bool empty() const { return !(spread[3] > 0); }
};

/// Bounds of twice the lights' centroids; the last of the four means nothing.
struct Range {
  Float4 lo = splat(kInfinity), hi = splat(-kInfinity);

  void add(const Float4& c) { lo = min4(lo, c), hi = max4(hi, c); }
  void add(const Range& r) { lo = min4(lo, r.lo), hi = max4(hi, r.hi); }
  /// Adds `c` if the mask is set in all lanes. Without a branch.
  void addIf(const Int4& mask, const Float4& c) {
    lo = min4(lo, mask ? c : splat(kInfinity));
    hi = max4(hi, mask ? c : splat(-kInfinity));
  }
};

/// Whether a light belongs into a tree: its intensity is positive, and all is finite.
bool usable(const LightBounds& bounds);

/// Ma 2018, eq. 3.1, with lengths in units of 1 / `invSize`.
float clusterCost(const Bucket& lights, float invSize);

}  // namespace lampyris
