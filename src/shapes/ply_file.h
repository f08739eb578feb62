// SPDX-License-Identifier: Apache-2.0
/// Meshes in PLY files.
#pragma once

#include <string_view>

#include "shapes/triangle_mesh.h"

namespace lampyris {

struct PlyMesh {
  TriangleMeshData data;
  size_t droppedFaces = 0;  ///< with fewer than three vertices
};

/// Reads the elements "vertex" (x y z, nx ny nz, one of u v / s t / texture_u texture_v /
/// texture_s texture_t; any scalar type, any order) and "face" (vertex_indices or vertex_index) and
/// skips all others. Quads become (0 1 2) and (3 0 2) as in pbrt-v3, larger polygons fans. Throws
/// std::runtime_error that says what is wrong; never reads beyond `file`, and allocates no more
/// than in proportion to its size.
PlyMesh parsePly(std::string_view file);

}  // namespace lampyris
