// SPDX-License-Identifier: Apache-2.0
/// Multiple importance sampling over all ways to make a path from both ends.
#pragma once

#include <vector>

#include "base/integrator.h"
#include "integrators/emitter_table.h"
#include "integrators/path_vertex.h"

namespace lampyris {

/// A whole path, from the light to the camera, of which the first `fromLight` vertices were drawn
/// from the light's side. One vertex: by light sampling at the next. None: it was found.
struct WholePath {
  std::vector<const PathVertex*> vertices;
  size_t fromLight = 0;

  size_t size() const { return vertices.size(); }
};

/// Weighs with the balance heuristic over the number of vertices from the light's side (Veach 1997,
/// §10.2). Where pbrt-v3 takes light sampling's density for that of emission, here it is its own.
/// As in pbrt-v3, in media densities leave out those of distances, which are not known in closed
/// form: collisions are drawn alike from both sides, and what remains of them is one over the
/// transmittance of the edge that joins. Any weights that sum to one over the strategies will do.
class PathDensities {
 public:
  /// `pixels`: how many are rendered; each has as many paths from the camera as from the lights.
  PathDensities(const Scene& scene, const Camera& camera, const EmitterTable& emitters,
                const LightDistribution* distribution, int64_t pixels)
      : scene_(scene),
        camera_(camera),
        emitters_(emitters),
        distribution_(distribution),
        pixels_(static_cast<double>(pixels)) {}

  /// Weight of the way in which the path was made: its density over the sum of all.
  double weight(const WholePath& path, float time) const;
  /// Density with which the camera chooses the direction `d`; 0 if it cannot be connected to.
  double cameraPdf(const Vec3& d, float time) const {
    return static_cast<double>(camera_.pixelsPerSteradian(d, time)) / pixels_;
  }

 private:
  double scattered(const PathVertex* before, const PathVertex& at, const PathVertex& next,
                   float time) const;
  double cameraDensity(const WholePath& path, size_t k, float time) const;
  double lightDensity(const WholePath& path, size_t k, float time) const;
  double startDensity(const WholePath& path, size_t fromLight) const;
  bool isPossible(const WholePath& path, size_t fromLight) const;

  const Scene& scene_;
  const Camera& camera_;
  const EmitterTable& emitters_;
  const LightDistribution* const distribution_;
  const double pixels_;
};

}  // namespace lampyris
