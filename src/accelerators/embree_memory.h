// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/geometry.h"

namespace lampyris {

/// Bytes that makeEmbreeGeometry() will take at most, about (docs/robustness.md says how near):
/// Embree's structures at the end and while it builds them. Meshes' own buffers, which Embree
/// shares, are not counted.
double estimateEmbreeMemory(const GeometryDescription& description);

}  // namespace lampyris
