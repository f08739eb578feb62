// SPDX-License-Identifier: Apache-2.0
/// A picture of what a guide has learned (after Bashford-Rogers et al. 2012, figure 3b).
#pragma once

#include <span>

#include "base/camera.h"
#include "base/integrator.h"
#include "core/image.h"

namespace lampyris {

/// Draws onto the image: a dot at each point that the camera sees, and a line from it along the
/// direction, the longer the narrower the lobe. Colours go from blue to red with the logarithm of
/// the radiance. Returns how many are in the picture. `first` is the image's upper left pixel on
/// the film; camera.projects() must hold.
size_t drawDirections(Image& image, const Int2& first, const Scene& scene, const Camera& camera,
                      std::span<const LearnedDirection> directions);

}  // namespace lampyris
