// SPDX-License-Identifier: Apache-2.0
/// Densities on a regular grid over the unit cube, with bounds for tracking.
#pragma once

#include <array>
#include <vector>

#include "base/ray.h"

namespace lampyris {

class DensityGrid {
 public:
  /// `values` of nx × ny × nz cells, x fastest; ≥ 0 and finite. `boundCells`: how many cells the
  /// grid of bounds has along each side, ≥ 1.
  DensityGrid(int nx, int ny, int nz, std::vector<float> values, int boundCells);

  /// Interpolated between the cells' centres, 0 outside of the cube; `p` in [0, 1]³.
  float density(const Vec3& p) const;

  /// Calls visit(t0, t1, bound) for the pieces of the ray (of any direction length) within the
  /// cube, in order; `bound` is at least the density there. visit() returns false to stop.
  template <class F>
  void track(const Ray& ray, F&& visit) const;

 private:
  float at(int x, int y, int z) const {
    if (x < 0 || y < 0 || z < 0 || x >= n_[0] || y >= n_[1] || z >= n_[2]) return 0;
    return values_[(static_cast<size_t>(z) * static_cast<size_t>(n_[1]) + static_cast<size_t>(y)) *
                       static_cast<size_t>(n_[0]) +
                   static_cast<size_t>(x)];
  }
  float& boundAt(int x, int y, int z) { return bounds_[boundIndex(x, y, z)]; }
  size_t boundIndex(int x, int y, int z) const {
    const auto n = static_cast<size_t>(coarse_);
    return (static_cast<size_t>(z) * n + static_cast<size_t>(y)) * n + static_cast<size_t>(x);
  }
  void makeBounds();

  std::array<int, 3> n_;
  std::vector<float> values_;
  int coarse_;                 ///< cells of `bounds_` along each side
  std::vector<float> bounds_;  ///< x fastest
};

template <class F>
void DensityGrid::track(const Ray& ray, F&& visit) const {
  // The piece of the ray in the cube.
  float t0 = 0, t1 = ray.tMax;
  for (int a = 0; a < 3; ++a) {
    const float inverse = 1 / ray.d[a];
    float near = -ray.o[a] * inverse, far = (1 - ray.o[a]) * inverse;
    if (std::isnan(near) || std::isnan(far)) continue;  // within a face, along it
    if (near > far) std::swap(near, far);
    t0 = std::max(t0, near);
    t1 = std::min(t1, far);
  }
  if (!(t0 < t1) || std::isinf(t1)) return;

  // From coarse cell to coarse cell (Amanatides and Woo 1987).
  const Vec3 start = ray.at(t0);
  const auto cells = static_cast<float>(coarse_);
  int cell[3], step[3];
  float next[3], delta[3];
  for (int a = 0; a < 3; ++a) {
    cell[a] = std::clamp(static_cast<int>(start[a] * cells), 0, coarse_ - 1);
    const bool up = ray.d[a] >= 0;
    step[a] = up ? 1 : -1;
    const float edge = static_cast<float>(cell[a] + up) / cells;
    next[a] = ray.d[a] == 0 ? kInfinity : (edge - ray.o[a]) / ray.d[a];
    delta[a] = ray.d[a] == 0 ? kInfinity : std::abs(1 / (cells * ray.d[a]));
  }
  while (t0 < t1) {
    const int a = next[0] < next[1] ? (next[0] < next[2] ? 0 : 2) : (next[1] < next[2] ? 1 : 2);
    const float end = std::min(next[a], t1);
    const float bound = bounds_[boundIndex(cell[0], cell[1], cell[2])];
    if (end > t0 && !visit(t0, end, bound)) return;
    t0 = std::max(t0, end);
    cell[a] += step[a];
    next[a] += delta[a];
    if (cell[a] < 0 || cell[a] >= coarse_) return;
  }
}

}  // namespace lampyris
