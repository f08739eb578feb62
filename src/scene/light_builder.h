// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/shape_builder.h"

namespace lampyris {

/// Builds the light sources and numbers all lights in the file's order: the scene takes them over,
/// primitives learn their lights' numbers. Lights without power are dropped.
void buildLights(BuildState& state, BuiltShapes& shapes, const Bounds3& sceneBounds);

}  // namespace lampyris
