// SPDX-License-Identifier: Apache-2.0
/// The elements of all shapes of a scene that Embree doesn't know, as one geometry: a ray that
/// comes by touches less memory than with one for each shape. Hits name the primitive in place of
/// the geometry.
#pragma once

#include <embree3/rtcore.h>

#include <bit>
#include <span>
#include <vector>

#include "accelerators/embree_ball_group.h"
#include "base/geometry.h"
#include "core/huge_pages.h"

namespace lampyris::embree {

/// Elements of shapes without triangles that Shape::ball() bounds.
size_t countBalls(const std::vector<Primitive>& primitives);

/// One of Embree's primitives is an element, or up to eight neighbours that Shape::ball() bounds.
/// Such a group takes the place of Embree's last node above them: a ray is held against all balls
/// at once, which are tighter than boxes and lie in two lines of memory.
class UserShapes {
 public:
  struct Element {
    uint32_t primitive = 0, element = 0;
    auto operator<=>(const Element&) const = default;  // NOLINT(modernize-use-nullptr): is none
  };
  /// All shapes of `primitives` without triangles; they must stay where they are.
  explicit UserShapes(const std::vector<Primitive>& primitives);

  /// Embree's primitives.
  uint32_t size() const { return static_cast<uint32_t>(singles_ + groups_.size()); }
  const Primitive& primitive(const Element& e) const { return primitives_[e.primitive]; }
  /// Calls take(element) for all elements of Embree's primitive `index`.
  template <class Take>
  void forEach(uint32_t index, const Take& take) const {
    if (index < singles_) return take(elements_[index]);
    const size_t group = index - singles_;
    forBits(group, groups_[group].all(), take);
  }
  /// Only for those that the ray may meet.
  template <class Take>
  void forEachMet(uint32_t index, const RTCRay& ray, const Take& take) const {
    if (index < singles_) return take(elements_[index]);
    const size_t group = index - singles_;
    forBits(group, groups_[group].met(ray), take);
  }

 private:
  struct Placed;
  /// Along a Z-order curve, so that what rays meet together lies together.
  static void sortInSpace(std::vector<Placed>& elements);
  static bool areClose(std::span<const Placed> balls);
  /// Of balls in that order.
  void group(std::span<const Placed> balls);

  template <class Take>
  void forBits(size_t group, uint32_t bits, const Take& take) const {
    const Element* const first = &elements_[singles_ + group * BallGroup::kSize];
    for (; bits != 0; bits &= bits - 1) take(first[std::countr_zero(bits)]);
  }

  const std::vector<Primitive>& primitives_;
  size_t singles_ = 0;             ///< elements without a ball, which come first
  std::vector<Element> elements_;  ///< then BallGroup::kSize places a group
  HugeVector<BallGroup> groups_;
};

}  // namespace lampyris::embree
