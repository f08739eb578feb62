// SPDX-License-Identifier: Apache-2.0
/// Axis-aligned boxes.
#pragma once

#include "core/math.h"
#include "core/vector.h"

namespace lampyris {

/// A box in space; default-constructed it is empty (min > max) and neutral to `extend`.
struct Bounds3 {
  Vec3 min{kInfinity}, max{-kInfinity};

  Bounds3() = default;
  explicit Bounds3(const Vec3& p) : min(p), max(p) {}
  Bounds3(const Vec3& a, const Vec3& b) : min(glm::min(a, b)), max(glm::max(a, b)) {}

  void extend(const Vec3& p) { min = glm::min(min, p), max = glm::max(max, p); }
  void extend(const Bounds3& b) { min = glm::min(min, b.min), max = glm::max(max, b.max); }
  bool empty() const { return !(min.x <= max.x && min.y <= max.y && min.z <= max.z); }
  Vec3 centroid() const { return 0.5f * min + 0.5f * max; }
  /// Edge lengths; zero for an empty box.
  Vec3 extent() const { return empty() ? Vec3(0) : max - min; }
  float diagonal() const { return length(extent()); }
  float surfaceArea() const {
    const Vec3 e = extent();
    return 2 * (e.x * e.y + e.y * e.z + e.z * e.x);
  }
  int longestAxis() const {
    const Vec3 e = extent();
    return e.x >= e.y ? (e.x >= e.z ? 0 : 2) : (e.y >= e.z ? 1 : 2);
  }
  bool contains(const Vec3& p) const {
    return p.x >= min.x && p.x <= max.x && p.y >= min.y && p.y <= max.y && p.z >= min.z &&
           p.z <= max.z;
  }
  Vec3 corner(int i) const {
    return {i & 1 ? max.x : min.x, i & 2 ? max.y : min.y, i & 4 ? max.z : min.z};
  }
};

/// A half-open rectangle of pixels: min ≤ p < max.
struct PixelBounds {
  Int2 min{0, 0}, max{0, 0};

  Int2 size() const { return glm::max(max - min, Int2(0)); }
  int64_t area() const { return static_cast<int64_t>(size().x) * size().y; }
  bool contains(const Int2& p) const {
    return p.x >= min.x && p.y >= min.y && p.x < max.x && p.y < max.y;
  }
  bool operator==(const PixelBounds&) const = default;
};

inline PixelBounds intersect(const PixelBounds& a, const PixelBounds& b) {
  return {glm::max(a.min, b.min), glm::min(a.max, b.max)};
}

}  // namespace lampyris
