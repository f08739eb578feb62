// SPDX-License-Identifier: Apache-2.0
/// Filter importance sampling along one axis, by a table (Ernst, Stamminger and Greiner 2006,
/// "Filter Importance Sampling").
#pragma once

#include <functional>

#include "core/sampling.h"

namespace lampyris {

/// A piecewise-constant density over [−radius, radius] that follows |f|, and ∫f. The density is
/// > 0 on the whole interval, so f / (density · ∫f) is an exact weight whatever the table's size.
class AxisTable {
 public:
  struct Sample {
    float offset;   ///< in pixels
    double factor;  ///< 1 / (density · ∫f): times f(offset) it is the weight
  };

  AxisTable() = default;
  /// `f` is tabulated on [−radius, radius] in `cells` cells, within each of which it should be
  /// smooth. Throws SceneError if ∫f is not clearly positive.
  AxisTable(const std::function<double(double)>& f, double radius, size_t cells);

  Sample sample(float u) const {
    const auto s = density_.sample(u);
    return {(2 * s.x - 1) * radius_, factor_ / static_cast<double>(s.pdf)};
  }

 private:
  Distribution1D density_;
  float radius_ = 0;
  double factor_ = 0;  ///< 2 radius / ∫f: from a density over [0, 1)
};

}  // namespace lampyris
