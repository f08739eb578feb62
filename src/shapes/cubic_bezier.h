// SPDX-License-Identifier: Apache-2.0
/// Cubic Bézier curves in double precision.
#pragma once

#include <array>
#include <glm/vec3.hpp>
#include <vector>

#include "core/vector.h"

namespace lampyris {

struct CubicBezier {
  using DVec3 = glm::dvec3;
  std::array<DVec3, 4> p{};

  DVec3 point(double t) const {
    const double s = 1 - t;
    return s * s * (s * p[0] + 3 * t * p[1]) + t * t * (3 * s * p[2] + t * p[3]);
  }
  DVec3 derivative(double t) const {
    const double s = 1 - t;
    return 3. * (s * s * (p[1] - p[0]) + 2 * s * t * (p[2] - p[1]) + t * t * (p[3] - p[2]));
  }
  /// The blossom: symmetric, affine in each argument, point(t) on the diagonal (Ramshaw 1987).
  DVec3 blossom(double a, double b, double c) const {
    const auto mix = [](double t, const DVec3& x, const DVec3& y) { return (1 - t) * x + t * y; };
    const DVec3 q0 = mix(a, p[0], p[1]), q1 = mix(a, p[1], p[2]), q2 = mix(a, p[2], p[3]);
    return mix(c, mix(b, q0, q1), mix(b, q1, q2));
  }
  /// Both halves, each over [0, 1] again (de Casteljau).
  std::array<CubicBezier, 2> halves() const {
    const DVec3 a = 0.5 * (p[0] + p[1]), b = 0.5 * (p[1] + p[2]), c = 0.5 * (p[2] + p[3]);
    const DVec3 ab = 0.5 * (a + b), bc = 0.5 * (b + c), middle = 0.5 * (ab + bc);
    return {{{{p[0], a, ab, middle}}, {{middle, bc, c, p[3]}}}};
  }
  /// The piece between two parameters, over [0, 1] again.
  CubicBezier piece(double from, double to) const {
    return {{blossom(from, from, from), blossom(from, from, to), blossom(from, to, to),
             blossom(to, to, to)}};
  }
};

enum class CurveBasis : uint8_t { Bezier, BSpline };

/// How many segments so many control points give; 0 where the count does not fit.
size_t curveSegmentCount(size_t points, size_t degree, CurveBasis basis);
/// A segment as a cubic Bézier curve, from control points of degree 2 or 3; B-splines are uniform.
CubicBezier curveSegment(const std::vector<Vec3>& points, size_t segment, size_t degree,
                         CurveBasis basis);

}  // namespace lampyris
