// SPDX-License-Identifier: Apache-2.0
/// Direct light by brute force in double precision: nothing of it is shared with the renderer. The
/// same description is written as a scene file, so that both see the same numbers.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "support/tiny_scenes.h"

namespace lampyris::test {

using DVec3 = glm::dvec3;

/// How big a scene is, and how far from the origin. What is placed is rounded to floats.
struct Place {
  double scale = 1;
  DVec3 offset{0};  ///< in units of the scene

  DVec3 operator()(const DVec3& p) const;
  float length(double l) const { return static_cast<float>(scale * l); }
  /// Distance of the floats about `p`, in world units, axis by axis.
  DVec3 rounding(const DVec3& p) const;
};
void PrintTo(const Place& place, std::ostream* out);

/// Emits on the side that its normal, (b − a) × (c − a), points to.
struct DTriangle {
  DVec3 a, b, c;
  double radiance = 0;
};
struct DBall {
  DVec3 centre;
  double radius = 0, radiance = 0;
};
struct DLamp {
  DVec3 at;
  double intensity = 0;
};

/// Black emitters and blockers about a matte floor at z = 0, seen from straight above its point
/// (0, 0, 0). In units of the scene until it is placed.
struct DScene {
  std::vector<DTriangle> triangles;
  std::vector<DBall> balls;
  std::vector<DLamp> lamps;
  double albedo = 0.5;
  /// Half the floor's width, and how far above it the camera is.
  double floor = 4, eye = 2.5;

  /// A parallelogram; its normal is along e1 × e2.
  void addQuad(const DVec3& corner, const DVec3& e1, const DVec3& e2, double radiance = 0);
  DScene placed(const Place& place) const;
  /// The file of a placed scene; `view`'s camera is replaced.
  std::string text(TinyView view, const Place& place) const;
  /// Irradiance at `p` with normal +z of a placed scene, by midpoints: `cells`² for each emitter.
  double irradiance(const DVec3& p, int cells) const;

 private:
  bool isBlocked(const DVec3& from, const DVec3& to, const void* emitter) const;
};

/// Radiance of the floor's middle, and what the rounding of points there and of the quadrature may
/// be off.
struct Expected {
  double radiance = 0, slack = 0;
};
Expected expectedRadiance(const DScene& placed, const Place& place, int cells = 200);

}  // namespace lampyris::test
