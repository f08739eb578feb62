// SPDX-License-Identifier: Apache-2.0
/// Parameters that integrators have in common.
#pragma once

#include <string>
#include <vector>

#include "core/parameters.h"

namespace lampyris {

/// Pixels that renderedPixels() (render_loop.h) takes.
inline void declarePixelBounds(Declaration& d, std::vector<int>& bounds) {
  d.add("pixelbounds", bounds, "Renders only these pixels: x0 x1 y0 y1.")
      .defaultIs("all")
      .rangeIs("x0 < x1 and y0 < y1, with pixels of the film");
}

/// A name for IntegratorContext::lightDistribution(). `doc` says what lights are sampled for.
inline void declareLightSampler(Declaration& d, std::string& name,
                                std::string doc =
                                    "Which light to sample at a point; see kind "
                                    "lightsampler.") {
  d.add("lightsampler", name, std::move(doc))
      .alias("lightsamplestrategy")
      .defaultIs("bvh")
      .rangeIs("a name of kind lightsampler");
}

/// For integrators that connect paths of the camera with paths of lights.
inline void declareVertexLightSampler(Declaration& d, std::string& name) {
  declareLightSampler(d, name,
                      "Which light to sample at a vertex of the camera's path; see kind "
                      "lightsampler. Paths from lights start by power.");
}

}  // namespace lampyris
