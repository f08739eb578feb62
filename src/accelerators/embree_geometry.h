// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/geometry.h"

namespace lampyris {

/// Builds the two-level Embree scene. Shapes and primitives of `description` must outlive it.
std::unique_ptr<Geometry> makeEmbreeGeometry(GeometryDescription description);

}  // namespace lampyris
