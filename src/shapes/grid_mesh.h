// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace lampyris {

/// Indices of the triangles over a grid of nu × nv vertices, row after row; each cell is split
/// along the diagonal from its first corner, as in pbrt-v3.
inline std::vector<uint32_t> gridTriangles(size_t nu, size_t nv) {
  std::vector<uint32_t> indices;
  indices.reserve(6 * (nu - 1) * (nv - 1));
  for (size_t v = 0; v + 1 < nv; ++v) {
    for (size_t u = 0; u + 1 < nu; ++u) {
      const auto a = static_cast<uint32_t>(v * nu + u), d = static_cast<uint32_t>(a + nu);
      indices.insert(indices.end(), {a, a + 1, d + 1, a, d + 1, d});
    }
  }
  return indices;
}

}  // namespace lampyris
