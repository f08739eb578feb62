// SPDX-License-Identifier: Apache-2.0
/// Filters that are a product of two even functions of one variable.
#pragma once

#include <cmath>

#include "base/filter.h"
#include "core/error.h"
#include "film/axis_table.h"

namespace lampyris {

/// Widths of filters are half-widths in pixels, as in pbrt-v3.
inline constexpr double kMinFilterWidth = 1e-3, kMaxFilterWidth = 100;

/// `Axis` has double operator()(double x) const (even, 0 beyond radius()), double radius(), double
/// tableRadius() (≤ radius; the function is negligible beyond it) and size_t cells().
template <class Axis>
class SeparableFilter final : public Filter {
 public:
  SeparableFilter(const Axis& x, const Axis& y)
      : x_(x), y_(y), xTable_(table(x)), yTable_(table(y)) {}

  Vec2 radius() const override {
    return {static_cast<float>(x_.radius()), static_cast<float>(y_.radius())};
  }
  float evaluate(const Vec2& offset) const override {
    return static_cast<float>(x_(static_cast<double>(offset.x)) *
                              y_(static_cast<double>(offset.y)));
  }
  FilterSample sample(const Vec2& u) const override {
    const auto x = xTable_.sample(u.x), y = yTable_.sample(u.y);
    const double weight =
        x_(static_cast<double>(x.offset)) * x.factor * y_(static_cast<double>(y.offset)) * y.factor;
    return {{x.offset, y.offset}, static_cast<float>(weight)};
  }

 private:
  static AxisTable table(const Axis& axis) {
    return AxisTable([&axis](double x) { return axis(x); }, axis.tableRadius(), axis.cells());
  }
  Axis x_, y_;
  AxisTable xTable_, yTable_;
};

}  // namespace lampyris
