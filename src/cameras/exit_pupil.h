// SPDX-License-Identifier: Apache-2.0
/// Where on its last interface a lens lets light through to the film.
#pragma once

#include <array>

#include "cameras/lens_system.h"

namespace lampyris {

/// A rectangle of the plane of the last interface, in metres.
struct PupilBox {
  glm::dvec2 min{HUGE_VAL}, max{-HUGE_VAL};

  bool empty() const { return !(min.x <= max.x); }
  double area() const { return (max.x - min.x) * (max.y - min.y); }
  void extend(const glm::dvec2& p) { min = glm::min(min, p), max = glm::max(max, p); }
  void grow(double by) { min -= by, max += by; }
};

/// Boxes around the exit pupil as points of the film's +x axis see it, one for each of equal
/// intervals of their distance from the centre; points elsewhere see it turned. As in pbrt-v3 a box
/// has a margin, on which the exposure depends: weights relate to the first box's area.
class ExitPupil {
 public:
  ExitPupil() = default;
  /// `filmRadius`: half the film's diagonal.
  ExitPupil(const LensSystem& lens, double filmRadius);

  const PupilBox& box(double distance) const {
    const double i = distance / filmRadius_ * kIntervals;
    return boxes_[std::min(static_cast<size_t>(i), kIntervals - 1)];
  }

 private:
  static constexpr size_t kIntervals = 64;
  double filmRadius_ = 1;
  std::array<PupilBox, kIntervals> boxes_;
};

}  // namespace lampyris
