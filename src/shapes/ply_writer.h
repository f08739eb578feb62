// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "shapes/triangle_mesh.h"

namespace lampyris {

/// Writes positions, normals, uvs and triangles as a binary PLY file from which parsePly() reads
/// the same bits; tangents, which PLY has no names for, are left out. Throws IoError.
void writePly(const std::string& path, const TriangleMeshData& mesh);

}  // namespace lampyris
