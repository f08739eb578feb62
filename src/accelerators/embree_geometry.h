// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/geometry.h"

struct RTCSceneTy;  // Embree's, so that its headers stay out of this one

namespace lampyris {

/// Builds the two-level Embree scene. Shapes and primitives of `description` must outlive it.
std::unique_ptr<Geometry> makeEmbreeGeometry(GeometryDescription description);

/// The RTCScene behind a geometry that makeEmbreeGeometry() made: for benchmarks against bare
/// Embree.
RTCSceneTy* embreeScene(const Geometry& geometry);

}  // namespace lampyris
