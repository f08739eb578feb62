// SPDX-License-Identifier: Apache-2.0
#include "materials/catmull_rom.h"

#include <algorithm>
#include <cmath>

#include "materials/root.h"

namespace lampyris {

namespace {

/// The interval [i, i + 1] of nodes that `x` lies in, or the nearest one.
size_t intervalOf(std::span<const float> nodes, float x) {
  const auto above = std::upper_bound(nodes.begin(), nodes.end(), x);
  const auto i = static_cast<size_t>(std::max<ptrdiff_t>(above - nodes.begin(), 1) - 1);
  return std::min(i, nodes.size() - 2);
}

/// The cubic between two nodes, for t in [0, 1]; slopes by t.
struct Cubic {
  float f0, f1, d0, d1;

  /// `f(k)` is the value at node k.
  template <class F>
  Cubic(std::span<const float> nodes, size_t i, const F& f) : f0(f(i)), f1(f(i + 1)) {
    const float width = nodes[i + 1] - nodes[i];
    d0 = i > 0 ? width * (f1 - f(i - 1)) / (nodes[i + 1] - nodes[i - 1]) : f1 - f0;
    d1 = i + 2 < nodes.size() ? width * (f(i + 2) - f0) / (nodes[i + 2] - nodes[i]) : f1 - f0;
  }
  float cubed() const { return d0 + d1 + 2 * (f0 - f1); }
  float squared() const { return 3 * (f1 - f0) - 2 * d0 - d1; }
  float value(float t) const { return f0 + t * (d0 + t * (squared() + t * cubed())); }
  float slope(float t) const { return d0 + t * (2 * squared() + t * 3 * cubed()); }
  /// ∫ value from 0 to t.
  float integral(float t) const {
    return t * (f0 + t * (d0 / 2 + t * (squared() / 3 + t * cubed() / 4)));
  }
};

}  // namespace

std::optional<SplineWeights> splineWeights(std::span<const float> nodes, float x) {
  if (!(x >= nodes.front() && x <= nodes.back())) return std::nullopt;
  const size_t i = intervalOf(nodes, x);
  const float width = nodes[i + 1] - nodes[i];
  const float t = (x - nodes[i]) / width, t2 = t * t, t3 = t2 * t;
  // Hermite's basis; each slope is a difference of two nodes' values, spread over their weights.
  SplineWeights s;
  s.first = static_cast<int>(i) - 1;
  auto& w = s.weight;
  w[1] = 2 * t3 - 3 * t2 + 1;
  w[2] = 3 * t2 - 2 * t3;
  const bool hasLeft = i > 0, hasRight = i + 2 < nodes.size();
  const float slope0 = (t3 - 2 * t2 + t) * (hasLeft ? width / (nodes[i + 1] - nodes[i - 1]) : 1.f);
  w[2] += slope0;
  w[hasLeft ? 0 : 1] -= slope0;
  const float slope1 = (t3 - t2) * (hasRight ? width / (nodes[i + 2] - nodes[i]) : 1.f);
  w[hasRight ? 3 : 2] += slope1;
  w[1] -= slope1;
  return s;
}

float invertSpline(std::span<const float> nodes, std::span<const float> values, float y) {
  if (!(y > values.front())) return nodes.front();
  if (!(y < values.back())) return nodes.back();
  const size_t i = intervalOf(values, y);
  const Cubic c(nodes, i, [&](size_t k) { return values[k]; });
  const float t =
      solveIncreasing([&](float s) { return std::pair(c.value(s), c.slope(s)); }, 0.f, 1.f, y);
  return nodes[i] + t * (nodes[i + 1] - nodes[i]);
}

SplineGrid::SplineGrid(std::vector<float> xs, std::vector<float> ys, std::vector<float> values)
    : xs_(std::move(xs)), ys_(std::move(ys)), values_(std::move(values)), cdf_(values_.size()) {
  const size_t n = ys_.size();
  for (size_t x = 0; x < xs_.size(); ++x) {
    double sum = 0;
    for (size_t y = 0; y + 1 < n; ++y) {
      const Cubic c(ys_, y, [&](size_t k) { return values_[x * n + k]; });
      sum += static_cast<double>(c.integral(1) * (ys_[y + 1] - ys_[y]));
      cdf_[x * n + y + 1] = static_cast<float>(sum);
    }
  }
}

std::vector<float> SplineGrid::totals() const {
  std::vector<float> all;
  for (size_t x = 1; x <= xs_.size(); ++x) all.push_back(cdf_[x * ys_.size() - 1]);
  return all;
}

std::optional<SplineGrid::Row> SplineGrid::row(float x) const {
  const auto weights = splineWeights(xs_, x);
  return weights ? std::optional(Row(this, *weights)) : std::nullopt;
}

float SplineGrid::Row::at(const std::vector<float>& table, size_t y) const {
  float sum = 0;
  for (size_t k = 0; k < 4; ++k) {
    // A weight of 0 may belong to a node that does not exist.
    if (weights_.weight[k] == 0) continue;
    const auto x = weights_.node(k);
    sum += weights_.weight[k] * table[x * grid_->ys_.size() + y];
  }
  return sum;
}

float SplineGrid::Row::value(float y) const {
  const auto w = splineWeights(grid_->ys_, y);
  if (!w) return 0;
  float sum = 0;
  for (size_t k = 0; k < 4; ++k)
    if (w->weight[k] != 0) sum += w->weight[k] * at(grid_->values_, w->node(k));
  return sum;
}

std::optional<float> SplineGrid::Row::sample(float u) const {
  const float all = total();
  if (!(all > 0)) return std::nullopt;
  const float target = u * all;
  // The last interval that begins below the target.
  const auto& ys = grid_->ys_;
  size_t low = 0, high = ys.size() - 1;
  while (high - low > 1) {
    const size_t middle = (low + high) / 2;
    (at(grid_->cdf_, middle) <= target ? low : high) = middle;
  }
  const float width = ys[low + 1] - ys[low];
  const Cubic c(ys, low, [this](size_t k) { return at(grid_->values_, k); });
  const float t = solveIncreasing([&](float s) { return std::pair(c.integral(s), c.value(s)); },
                                  0.f, 1.f, (target - at(grid_->cdf_, low)) / width);
  return ys[low] + t * width;
}

}  // namespace lampyris
