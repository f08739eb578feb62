// SPDX-License-Identifier: Apache-2.0
/// One segment of a curve with a width, and rays that meet it (Nakamaru and Ohno 2002, "Ray Tracing
/// for Curves Primitive"). As in pbrt-v3 every curve is a flat strip to the ray that meets it, at
/// the depth of the curve's middle.
#pragma once

#include <optional>

#include "shapes/cubic_bezier.h"

namespace lampyris {

/// A place on the strip: distance along the ray in units of length, u along the segment, v across
/// it with 0.5 in the middle.
struct CurveHit {
  double z = 0, u = 0, v = 0;
};

struct CurveSegment {
  using DVec3 = glm::dvec3;
  CubicBezier curve;
  double startWidth = 1, endWidth = 1;
  bool oriented = false;  ///< a ribbon: it has a side of its own, and looks narrow along it
  DVec3 startNormal{0, 0, 1}, endNormal{0, 0, 1};  ///< unit; between them on the great circle

  double width(double u) const { return (1 - u) * startWidth + u * endWidth; }
  DVec3 normal(double u) const;
  /// The width seen along the unit direction `w`.
  double widthSeen(double u, const DVec3& w) const;

  /// The nearest hit at 0 < z < zMax with the piece [u0, u1], for a ray in the unit direction `w`.
  std::optional<CurveHit> intersect(double u0, double u1, const DVec3& origin, const DVec3& w,
                                    double zMax) const;
};

}  // namespace lampyris
