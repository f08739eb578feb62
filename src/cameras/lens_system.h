// SPDX-License-Identifier: Apache-2.0
/// Rays through the elements of a lens (Kolb et al. 1995, "A Realistic Camera Model for Computer
/// Graphics").
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <vector>

#include "core/vector.h"

namespace lampyris {

using DVec3 = glm::dvec3;

/// One interface, in metres. Lists run from the scene to the film, as lens files do.
struct LensElement {
  double curvatureRadius = 0;  ///< > 0: convex towards the scene; 0: the aperture stop
  double thickness = 0;        ///< along the axis to the next interface, or to the film
  double eta = 1;              ///< index of refraction of what is behind it; 0 counts as 1
  double apertureRadius = 0;
  bool isStop() const { return curvatureRadius == 0; }
};

struct LensRay {
  DVec3 o{0}, d{0, 0, 1};
  DVec3 at(double t) const { return o + t * d; }
};

/// Camera space: the film at z = 0, the scene towards +z, the axis of the lens at x = y = 0.
class LensSystem {
 public:
  /// Throws std::runtime_error where the list is no lens.
  explicit LensSystem(std::vector<LensElement> elements);

  /// Moves the lens so that what is `distance` from the film is in focus on it, by the thick-lens
  /// approximation as pbrt-v3 has it, measured by rays `offset` from the axis. Throws
  /// std::runtime_error where that cannot be.
  void focus(double distance, double offset);

  double rearZ() const { return z_.back(); }  ///< of the interface nearest to the film
  double frontZ() const { return z_.front(); }
  double rearRadius() const { return elements_.back().apertureRadius; }

  /// Where a ray from the film leaves the lens; none if it is stopped.
  std::optional<LensRay> traceFromFilm(LensRay ray) const;
  /// The other way round; the result points to the film.
  std::optional<LensRay> traceFromScene(LensRay ray) const;

 private:
  /// Through interface `i`, from the medium of index `from` into that of index `to`.
  bool cross(size_t i, double from, double to, LensRay& ray) const;
  double behind(size_t i) const;
  double before(size_t i) const { return i > 0 ? behind(i - 1) : 1; }
  void place();

  std::vector<LensElement> elements_;
  std::vector<double> z_;  ///< of the interfaces
};

}  // namespace lampyris
