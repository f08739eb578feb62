// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <memory>
#include <vector>

#include "base/geometry.h"
#include "scene/build_state.h"

namespace lampyris {

/// A shape of the description that is in the scene. What it owns until the scene takes it over is
/// what `primitive` points to.
struct BuiltShape {
  const ShapeDescription* description = nullptr;
  uint32_t object = kNone;  ///< in Description::objects; kNone: of the world
  /// In Description::transforms, if the shape moves: it is built without its transform.
  uint32_t motion = kNone;
  Primitive primitive;  ///< without firstLight until the lights have numbers
  std::unique_ptr<Light> light;
  Bounds3 bounds;  ///< at all times
};

struct BuiltShapes {
  std::vector<BuiltShape> shapes;     ///< in the file's order
  Bounds3 worldBounds;                ///< of the shapes that are in no object
  std::vector<Bounds3> objectBounds;  ///< in the objects' own space
};

class MediumBuilder;

/// Builds the shapes of the world and of objects that are placed, in parallel, with their
/// materials, alpha textures, media and area lights.
BuiltShapes buildShapes(BuildState& state, MediumBuilder& media);

}  // namespace lampyris
