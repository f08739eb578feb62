// SPDX-License-Identifier: Apache-2.0
#include "core/sampling.h"

namespace lampyris {

namespace {

Vec3 aboutZ(float sinTheta, float cosTheta, float turns) {
  return {sinTheta * circlePoint(turns), cosTheta};
}

}  // namespace

Vec3 sampleUniformSphere(const Vec2& u) {
  const float z = 1 - 2 * u.x;
  return aboutZ(std::sqrt(std::max(0.f, 1 - z * z)), z, u.y);
}

Vec3 sampleUniformCone(const Vec2& u, float oneMinusCosMax) {
  // With h = 1 − cos θ: sin²θ = h (2 − h), which does not cancel for small h.
  const float h = u.x * oneMinusCosMax;
  return aboutZ(std::sqrt(std::max(0.f, h * (2 - h))), 1 - h, u.y);
}

Vec2 sampleUniformTriangle(const Vec2& u) {
  return u.x < u.y ? Vec2(u.x / 2, u.y - u.x / 2) : Vec2(u.x - u.y / 2, u.y / 2);
}

Distribution1D::Distribution1D(std::span<const float> values) {
  const size_t n = values.size();
  std::vector<double> sums(n + 1, 0.);
  for (size_t i = 0; i < n; ++i) {
    const float v = values[i];
    sums[i + 1] = sums[i] + (v > 0 && std::isfinite(v) ? v : 0);
  }
  const double total = sums[n];
  integral_ = n ? total / static_cast<double>(n) : 0;
  cdf_.resize(n + 1);
  for (size_t i = 0; i <= n; ++i)
    cdf_[i] = static_cast<float>(total > 0 ? sums[i] / total
                                           : static_cast<double>(i) / static_cast<double>(n));
}

Distribution1D::Sample Distribution1D::sample(float u) const {
  const auto above = std::upper_bound(cdf_.begin(), cdf_.end(), u);
  size_t cell = static_cast<size_t>(std::max<std::ptrdiff_t>(above - cdf_.begin() - 1, 0));
  cell = std::min(cell, size() - 1);
  // Rounding may leave u in a cell without mass at the end; the last one with mass takes it.
  while (cell > 0 && pmf(cell) == 0) --cell;
  const float within = std::min((u - cdf_[cell]) / pmf(cell), kOneMinusEpsilon);
  float x =
      std::min((static_cast<float>(cell) + within) / static_cast<float>(size()), kOneMinusEpsilon);
  // Rounding may carry x over the border to a cell of another density.
  while (cellOf(x) > cell) x = nextFloatDown(x);
  while (cellOf(x) < cell) x = nextFloatUp(x);
  return {x, density(cell), cell};
}

Distribution2D::Distribution2D(std::span<const float> values, int width, int height) {
  std::vector<float> means;
  const auto w = static_cast<size_t>(width), h = static_cast<size_t>(height);
  rows_.reserve(h);
  means.reserve(h);
  for (size_t y = 0; y < h; ++y) {
    rows_.emplace_back(values.subspan(y * w, w));
    means.push_back(static_cast<float>(rows_.back().integral()));
  }
  marginal_ = Distribution1D(means);
}

Distribution2D::Sample Distribution2D::sample(const Vec2& u) const {
  const auto y = marginal_.sample(u.y);
  const auto x = rows_[y.cell].sample(u.x);
  return {{x.x, y.x}, x.pdf * y.pdf};
}

float Distribution2D::pdf(const Vec2& p) const {
  const auto n = static_cast<float>(rows_.size());
  const size_t row = std::min(static_cast<size_t>(std::max(p.y, 0.f) * n), rows_.size() - 1);
  return marginal_.density(row) * rows_[row].pdf(p.x);
}

}  // namespace lampyris
