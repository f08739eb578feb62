// SPDX-License-Identifier: Apache-2.0
#include "media/density_grid.h"

#include <algorithm>

namespace lampyris {

DensityGrid::DensityGrid(int nx, int ny, int nz, std::vector<float> values, int boundCells)
    : n_{nx, ny, nz}, values_(std::move(values)), coarse_(boundCells) {
  makeBounds();
}

float DensityGrid::density(const Vec3& p) const {
  int low[3];
  float part[3];
  for (int a = 0; a < 3; ++a) {
    const float x = p[a] * static_cast<float>(n_[static_cast<size_t>(a)]) - 0.5f;
    const float floor = std::floor(x);
    low[a] = static_cast<int>(floor);
    part[a] = x - floor;
  }
  const auto along = [&](int y, int z) {
    return lerp(part[0], at(low[0], y, z), at(low[0] + 1, y, z));
  };
  const auto across = [&](int z) { return lerp(part[1], along(low[1], z), along(low[1] + 1, z)); };
  return lerp(part[2], across(low[2]), across(low[2] + 1));
}

/// A value counts for all coarse cells that its cell's interpolation reaches: one cell around it.
void DensityGrid::makeBounds() {
  bounds_.assign(
      static_cast<size_t>(coarse_) * static_cast<size_t>(coarse_) * static_cast<size_t>(coarse_),
      0.f);
  // The span of coarse cells, with room for rounding in track() and density().
  const auto span = [&](int i, size_t axis, int& first, int& last) {
    const double n = n_[axis];
    first = std::clamp(static_cast<int>(std::floor((i - 0.51) / n * coarse_)), 0, coarse_ - 1);
    last = std::clamp(static_cast<int>(std::floor((i + 1.51) / n * coarse_)), 0, coarse_ - 1);
  };
  for (int z = 0; z < n_[2]; ++z)
    for (int y = 0; y < n_[1]; ++y)
      for (int x = 0; x < n_[0]; ++x) {
        const float value = at(x, y, z);
        if (!(value > 0)) continue;
        int x0, x1, y0, y1, z0, z1;
        span(x, 0, x0, x1), span(y, 1, y0, y1), span(z, 2, z0, z1);
        for (int k = z0; k <= z1; ++k)
          for (int j = y0; j <= y1; ++j)
            for (int i = x0; i <= x1; ++i) boundAt(i, j, k) = std::max(boundAt(i, j, k), value);
      }
}

}  // namespace lampyris
