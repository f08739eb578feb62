// SPDX-License-Identifier: Apache-2.0
#include "shapes/cubic_bezier.h"

namespace lampyris {

namespace {

using DVec3 = glm::dvec3;

/// The same curve as a cubic one.
CubicBezier elevated(const DVec3& a, const DVec3& b, const DVec3& c) {
  return {{a, (a + 2. * b) / 3., (2. * b + c) / 3., c}};
}

}  // namespace

size_t curveSegmentCount(size_t points, size_t degree, CurveBasis basis) {
  if (points < degree + 1) return 0;
  if (basis == CurveBasis::BSpline) return points - degree;
  return (points - 1) % degree == 0 ? (points - 1) / degree : 0;
}

CubicBezier curveSegment(const std::vector<Vec3>& points, size_t segment, size_t degree,
                         CurveBasis basis) {
  const size_t first = segment * (basis == CurveBasis::Bezier ? degree : 1);
  const auto at = [&](size_t i) { return DVec3(points[first + i]); };
  if (basis == CurveBasis::Bezier) {
    if (degree == 2) return elevated(at(0), at(1), at(2));
    return {{at(0), at(1), at(2), at(3)}};
  }
  if (degree == 2) return elevated(0.5 * (at(0) + at(1)), at(1), 0.5 * (at(1) + at(2)));
  return {{(at(0) + 4. * at(1) + at(2)) / 6., (2. * at(1) + at(2)) / 3., (at(1) + 2. * at(2)) / 3.,
           (at(1) + 4. * at(2) + at(3)) / 6.}};
}

}  // namespace lampyris
