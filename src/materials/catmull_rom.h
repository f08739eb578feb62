// SPDX-License-Identifier: Apache-2.0
/// Catmull–Rom splines through values at unequally spaced nodes: a cubic between two nodes whose
/// slopes at them are the central differences over their neighbours, one-sided at the ends.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "core/math.h"

namespace lampyris {

/// The spline's value at a place as a weighted sum of four nodes' values, from number `first` on;
/// weights of nodes that do not exist are 0 (`first` may be −1).
struct SplineWeights {
  int first = 0;
  std::array<float, 4> weight{};
  /// The number of the k-th node; meaningless where its weight is 0.
  size_t node(size_t k) const { return static_cast<size_t>(first) + k; }
};
/// None outside the nodes (and for NaN). `nodes`: at least two, ascending.
std::optional<SplineWeights> splineWeights(std::span<const float> nodes, float x);

/// Where the spline through ascending `values` has the value `y`; clamped to the ends.
float invertSpline(std::span<const float> nodes, std::span<const float> values, float y);

/// A function on a grid, a spline in both variables: density of `y` for any `x`.
class SplineGrid {
 public:
  SplineGrid() = default;
  /// `values[x * ys.size() + y]`; at least two nodes each, ascending.
  SplineGrid(std::vector<float> xs, std::vector<float> ys, std::vector<float> values);

  std::span<const float> xs() const { return xs_; }
  /// Integrals over y at the nodes of x.
  std::vector<float> totals() const;

  /// The function of y at one x.
  class Row {
   public:
    /// The function's value; 0 outside of the nodes. May be negative where the spline overshoots.
    float value(float y) const;
    /// Integral over all y.
    float total() const { return at(grid_->cdf_, grid_->ys_.size() - 1); }
    /// Draws y with density value(y) / total(). None unless the total is positive.
    std::optional<float> sample(float u) const;

   private:
    friend class SplineGrid;
    Row(const SplineGrid* grid, const SplineWeights& weights) : grid_(grid), weights_(weights) {}
    /// One of the grid's tables, interpolated at x.
    float at(const std::vector<float>& table, size_t y) const;
    const SplineGrid* grid_;
    SplineWeights weights_;
  };
  /// None outside the nodes.
  std::optional<Row> row(float x) const;

 private:
  std::vector<float> xs_, ys_, values_;
  std::vector<float> cdf_;  ///< integral of each row's spline from the first node on
};

}  // namespace lampyris
