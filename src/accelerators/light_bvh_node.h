// SPDX-License-Identifier: Apache-2.0
/// A node of the light BVH in 32 bytes, so that a cache line holds a node and its left child.
///
/// The centre is a full float, so lights far from the origin or from each other lose nothing (as
/// they would on a grid over the scene); all else is rounded outwards: a decoded node bounds its
/// lights.
#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>

#include "base/light.h"
#include "core/math.h"
#include "core/vector.h"

namespace lampyris {

/// Directions of emission: normals within θo of ±axis (only + if not two-sided), emission within θe
/// of a normal. θo in radians, both in [0, π].
struct EmissionCone {
  Vec3 axis{0, 0, 1};  ///< unit
  double thetaO = 0, cosThetaE = 1;
  bool twoSided = false;

  static EmissionCone of(const LightBounds& bounds);
  /// Normals in every direction.
  bool isFull() const;
  /// The largest value of a node's emission factor (light_bvh_importance.h), and its mean over all
  /// directions.
  double peakFactor() const;
  double meanFactor() const;
};
/// The mean of a cosine, 0 where negative, over unit vectors whose own mean has length `m` in [0,
/// 1] and that direction's cosine: max(0, cosine) for m = 1, ¼ for m = 0, where they go all ways,
/// and close to exact for caps in between.
inline float meanCosine(float cosine, float m) {
  const float c = cosine * m;
  return 0.5f * (c + std::sqrt(c * c + 0.25f * std::max(0.f, 1 - m * m)));
}
/// The same of the absolute value.
inline float meanAbsCosine(float cosine, float m) {
  return std::sqrt(sqr(cosine * m) + 0.25f * std::max(0.f, 1 - m * m));
}
/// The length of the mean of unit vectors spread evenly over a cap.
inline float capMean(float cosine) { return 0.5f + 0.5f * cosine; }

/// A cone that holds both. The axis is that of the two axes' common cone; opposite two-sided
/// cones stay as narrow as one of them.
EmissionCone merge(const EmissionCone& a, const EmissionCone& b);

/// Nodes lie depth first: the left child of node i is i + 1, the right one `rightChild()`; a
/// subtree of n lights takes 2n − 1 nodes in a row.
class alignas(32) LinearLightBVHNode {
 public:
  static constexpr uint32_t kMaxIndex = (uint32_t{1} << 31) - 1;

  LinearLightBVHNode() = default;
  /// `index`: the light's id or the right child.
  LinearLightBVHNode(const Bounds3& box, const EmissionCone& cone, float intensity, bool leaf,
                     uint32_t index);

  const Vec3& center() const { return center_; }
  /// Half the box's edges.
  Vec3 halfExtent() const { return {unpack(half_[0]), unpack(half_[1]), unpack(half_[2])}; }
  /// For one light, about LightBounds::intensity; for more, such that the mean over all directions
  /// is the sum of theirs.
  float intensity() const { return intensity_; }
  bool isLeaf() const { return index_ >> 31; }
  LightId light() const { return index_ & kMaxIndex; }
  uint32_t rightChild() const { return index_; }

  bool twoSided() const { return emission_ & 1; }
  /// True if normals may have any direction.
  bool allNormals() const { return (cone_ & kSineMax) == kSineMax; }
  /// Not unit.
  Vec3 axis() const;
  /// sin(θo / 2), which resolves small angles better than a cosine does.
  float halfSineO() const { return static_cast<float>(cone_ & kSineMax) * (1.f / kSineMax); }
  float cosThetaE() const {
    const float h = static_cast<float>(emission_ >> 1) * (1.f / kEmissionMax);
    return 1 - 2 * h * h;
  }

 private:
  static constexpr uint32_t kAxisMax = 1022, kSineMax = 4095, kEmissionMax = 32767;
  static float unpack(uint16_t v) { return std::bit_cast<float>(static_cast<uint32_t>(v) << 16); }

  // Without values: an array of nodes that are yet to be filled in should cost nothing.
  Vec3 center_;
  float intensity_;
  uint32_t index_;                ///< highest bit: leaf
  uint32_t cone_;                 ///< octahedral axis 2 × 10 bits, sin(θo/2) 12 bits
  std::array<uint16_t, 3> half_;  ///< upper halves of floats
  uint16_t emission_;             ///< sin(θe/2) 15 bits, two-sided 1 bit
};
static_assert(sizeof(LinearLightBVHNode) == 32);

inline Vec3 LinearLightBVHNode::axis() const {
  const float x = static_cast<float>(cone_ >> 22) * (2.f / kAxisMax) - 1;
  const float y = static_cast<float>(cone_ >> 12 & 1023) * (2.f / kAxisMax) - 1;
  const float z = 1 - std::abs(x) - std::abs(y);
  // Lower hemisphere: the outer triangles of the square, folded over.
  const float fold = std::max(-z, 0.f);
  return {x - std::copysign(fold, x), y - std::copysign(fold, y), z};
}

}  // namespace lampyris
