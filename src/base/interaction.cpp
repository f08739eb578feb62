// SPDX-License-Identifier: Apache-2.0
#include "base/interaction.h"

#include <cmath>

namespace lampyris {

void SurfaceInteraction::computeDifferentials(const RayDifferential& d) {
  // Where the offset rays meet the tangent plane.
  const float planeD = dot(n, p);
  const float tx = (planeD - dot(n, d.xOrigin)) / dot(n, d.xDirection);
  const float ty = (planeD - dot(n, d.yOrigin)) / dot(n, d.yDirection);
  if (!std::isfinite(tx) || !std::isfinite(ty)) return;
  dpdx = d.xOrigin + tx * d.xDirection - p;
  dpdy = d.yOrigin + ty * d.yDirection - p;

  // Least squares for (du, dv) in [dpdu dpdv] (du, dv)ᵀ = dp, by the normal equations.
  const float a = dot(dpdu, dpdu), b = dot(dpdu, dpdv), c = dot(dpdv, dpdv);
  const float determinant = a * c - b * b;
  const auto solve = [&](const Vec3& dp) {
    const float e = dot(dpdu, dp), f = dot(dpdv, dp);
    const Vec2 duv((c * e - b * f) / determinant, (a * f - b * e) / determinant);
    return std::isfinite(duv.x) && std::isfinite(duv.y) ? glm::clamp(duv, -1e8f, 1e8f) : Vec2(0);
  };
  duvdx = solve(dpdx);
  duvdy = solve(dpdy);
}

}  // namespace lampyris
