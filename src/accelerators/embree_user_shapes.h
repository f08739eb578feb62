// SPDX-License-Identifier: Apache-2.0
/// The elements of all shapes of a scene that Embree doesn't know, as one geometry: a ray that
/// comes by touches less memory than with one for each shape. Hits name the primitive in place of
/// the geometry.
#pragma once

#include <embree3/rtcore.h>

#include <vector>

#include "base/geometry.h"
#include "core/huge_pages.h"

namespace lampyris::embree {

/// Elements of shapes without triangles that Shape::ball() bounds.
size_t countBalls(const std::vector<Primitive>& primitives);

class UserShapes {
 public:
  struct Element {
    uint32_t primitive, element;
    auto operator<=>(const Element&) const = default;  // NOLINT(modernize-use-nullptr): is none
  };
  /// All shapes of `primitives` without triangles; they must stay where they are.
  explicit UserShapes(const std::vector<Primitive>& primitives);

  bool empty() const { return elements_.empty(); }
  uint32_t size() const { return static_cast<uint32_t>(elements_.size()); }
  /// By the number of Embree's primitive.
  const Element& operator[](uint32_t index) const { return elements_[index]; }
  const Primitive& primitive(const Element& e) const { return primitives_[e.primitive]; }
  /// True only if the ray misses the element; without a look at it.
  bool passesBy(const RTCRay& ray, uint32_t index) const;

 private:
  /// Along a Z-order curve, so that what rays meet together lies together.
  void sortInSpace(const std::vector<Vec3>& centres);
  void findBalls();

  const std::vector<Primitive>& primitives_;
  std::vector<Element> elements_;
  HugeVector<Ball> balls_;  ///< around them; empty where all are infinite
};

}  // namespace lampyris::embree
