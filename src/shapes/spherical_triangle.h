// SPDX-License-Identifier: Apache-2.0
/// A triangle as seen from a point: its solid angle and uniform directions within it.
#pragma once

#include <glm/vec3.hpp>

#include "core/vector.h"

namespace lampyris {

/// Flat surfaces whose two edges, squared and added, are less than this part of the squared
/// distance of their centroid are sampled by area: see docs/shape-sampling.md.
inline constexpr double kWide = 0.1;

class SphericalTriangle {
 public:
  /// The corners in relation to the point, and |det(a, b, c)|, which callers know more precisely
  /// than these: it is the distance from the plane times twice the area.
  SphericalTriangle(const glm::dvec3& a, const glm::dvec3& b, const glm::dvec3& c, double volume);

  /// In steradian, up to 2π; 0 if the point is in the plane or at a corner.
  float solidAngle() const { return solidAngle_; }
  /// Barycentric coordinates of the point seen in a direction that is uniform by solid angle. Each
  /// is ≥ 0 and their sum is 1 up to rounding. Not to be called where solidAngle() is 0.
  Vec3 sample(const Vec2& u) const;

 private:
  double a_, b_, c_;     ///< lengths
  double ab_, bc_, ca_;  ///< dot products
  double volume_;
  float solidAngle_ = 0;
};

}  // namespace lampyris
