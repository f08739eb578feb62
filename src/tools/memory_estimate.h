// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scene/builder.h"

namespace lampyris {

/// Bytes that the process will have taken at most, about: while the scene was loaded, or for the
/// render, which takes on top of the scene: what the integrator keeps, an image on its way into a
/// file and, where `savesState`, the film's sums on theirs. Throws SceneError where that is more
/// than there is.
double expectRenderMemory(const RenderJob& job, bool savesState);

}  // namespace lampyris
