// SPDX-License-Identifier: Apache-2.0
// Bump mapping: Blinn 1978, "Simulation of Wrinkled Surfaces", with the terms of the normal's own
// change and forward differences over half a pixel's footprint, as pbrt-v3 has it.
#include "materials/surface_material.h"

#include <cmath>

namespace lampyris {

namespace {

/// Step in u or v where no ray differential says how far a pixel reaches.
constexpr float kDefaultStep = 0.0005f;

float differenceStep(float dx, float dy) {
  const float step = 0.5f * (std::abs(dx) + std::abs(dy));
  return step > 0 && std::isfinite(step) ? step : kDefaultStep;
}

}  // namespace

SurfaceMaterial::SurfaceMaterial(const SurfaceParameters& p, const MaterialContext& context) {
  if (!p.bumpMap) return;
  bump_ = input(context, *p.bumpMap);
  bumps_ = !bump_.isConstant() || bump_.value != 0;
}

void SurfaceMaterial::bend(SurfaceInteraction& at) const {
  if (!bumps_) return;
  auto& shading = at.shading;
  const float du = differenceStep(at.duvdx.x, at.duvdy.x);
  const float dv = differenceStep(at.duvdx.y, at.duvdy.y);
  const Vec3 normal = cross(shading.dpdu, shading.dpdv);

  const float here = bump_(at);
  SurfaceInteraction shifted = at;
  shifted.p = at.p + du * shading.dpdu;
  shifted.uv = at.uv + Vec2(du, 0);
  shifted.n = normalize(normal + du * at.dndu);
  const float alongU = bump_(shifted);
  shifted.p = at.p + dv * shading.dpdv;
  shifted.uv = at.uv + Vec2(0, dv);
  shifted.n = normalize(normal + dv * at.dndv);
  const float alongV = bump_(shifted);

  const Vec3 dpdu = shading.dpdu + (alongU - here) / du * shading.n + here * shading.dndu;
  const Vec3 dpdv = shading.dpdv + (alongV - here) / dv * shading.n + here * shading.dndv;
  const Vec3 bent = normalize(cross(dpdu, dpdv));
  // No direction: degenerate derivatives, or a texture that is no number.
  if (!(lengthSquared(bent) > 0)) return;
  shading.n = faceForward(bent, at.n);
  shading.dpdu = dpdu;
  shading.dpdv = dpdv;
}

}  // namespace lampyris
