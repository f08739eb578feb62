// SPDX-License-Identifier: Apache-2.0
/// A node of the wide light BVH: up to eight children, side by side, so that all of them are
/// weighed at once with SIMD instructions.
///
/// Everything is in units of the node: positions relative to `origin` and times `invExtent`,
/// intensities relative to the strongest child. So nothing can overflow whatever the scene's scale
/// or its lights' power, and 160 bytes are enough for eight children. Boxes and cones are rounded
/// outwards: a decoded child bounds its lights.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <span>

#include "accelerators/light_bvh_node.h"

namespace lampyris {

struct alignas(32) WideLightBVHNode {
  static constexpr size_t kWidth = 8;
  template <class T>
  using Lanes = std::array<T, kWidth>;

  /// Encodes up to kWidth children; not their numbers and links. Its extent is at least
  /// `leastExtent` (> 0), which keeps the units of neighbouring nodes comparable. Returns the
  /// strongest child's intensity.
  float encode(std::span<const LinearLightBVHNode* const> children, float leastExtent);

  bool isLeaf(size_t lane) const { return leaves >> lane & 1; }
  /// Of a child that is an inner node: its number.
  uint32_t child(size_t lane) const { return firstChild + before(inner, lane); }
  /// Of a child that is a leaf: its place in the tree's list of lights.
  uint32_t light(size_t lane) const { return firstLight + before(leaves, lane); }

  std::array<Lanes<uint16_t>, 3> center{};  ///< of the box, in 1/65535
  std::array<Lanes<uint8_t>, 3> half{};     ///< half edge: ½ (v / 255)²
  std::array<Lanes<int8_t>, 3> axis{};      ///< not unit
  Lanes<uint8_t> halfSineO{};               ///< sin(θo / 2) in 1/255
  Lanes<uint8_t> cosineE{};                 ///< cos θe = v / 127 − 1
  Lanes<uint16_t> intensity{};              ///< upper half of a float; 0: no child
  Vec3 origin{0};
  float invExtent = 1;
  uint32_t firstChild = 0, firstLight = 0;
  /// Of a cluster that may be drawn from by intensity alone: the number of its lights, from
  /// firstLight on. 0 for any other node.
  uint32_t clusterLights : 31 = 0;
  uint32_t even : 1 = 0;  ///< whether those are about as strong as each other
  uint8_t leaves = 0, inner = 0;
  uint8_t allNormals = 0xff;  ///< children whose normals may have any direction, and no children
  uint8_t twoSided = 0;

 private:
  static uint32_t before(uint8_t set, size_t lane) {
    return static_cast<uint32_t>(std::popcount(static_cast<uint8_t>(set & ((1u << lane) - 1))));
  }
  void encodeBox(size_t lane, const LinearLightBVHNode& child);
  void encodeCone(size_t lane, const LinearLightBVHNode& child);
};
static_assert(sizeof(WideLightBVHNode) == 160);

}  // namespace lampyris
