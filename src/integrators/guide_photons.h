// SPDX-License-Identifier: Apache-2.0
/// Photons for guides.
#pragma once

#include "base/scene.h"
#include "guiding/photon_tree.h"

namespace lampyris {

/// Emits `count` photons, and as many more towards specular surfaces if there are any, and returns
/// where they come by on surfaces that are not specular, but for the first one. The same for any
/// number of threads. Photons pass media as if they were not there.
std::vector<GuidePhoton> traceGuidePhotons(const Scene& scene, int count, int maxDepth);

}  // namespace lampyris
