// SPDX-License-Identifier: Apache-2.0
/// Light that scatters below surfaces, for path integrators.
#pragma once

#include <optional>

#include "base/scene.h"
#include "integrators/render_loop.h"

namespace lampyris {

/// Whether any material has a BSSRDF: if not, paths need not ask theirs.
bool scattersBelowSurfaces(const Scene& scene);

/// Where light that leaves below a surface has entered.
struct SubsurfaceEntry {
  SurfaceInteraction at;  ///< wo is the shading normal: the lobe there is diffuse
  Rgb weight;             ///< profile over density
};
/// Draws an entry point for light that leaves at `exit`, whose shading frame is `frame`. None if
/// none is found. `time`: of the probe rays.
std::optional<SubsurfaceEntry> sampleSubsurfaceEntry(const Geometry& geometry,
                                                     const Material& material, const Bssrdf& bssrdf,
                                                     const SurfaceInteraction& exit,
                                                     const Frame& frame, float time, float uc,
                                                     const Vec2& u, RayCounts& rays);

}  // namespace lampyris
