// SPDX-License-Identifier: Apache-2.0
/// The boundary of a dielectric body, smooth or rough: what glass is, and what light meets before
/// it scatters below a surface.
#pragma once

#include "materials/rough_dielectric.h"
#include "materials/roughness.h"
#include "materials/smooth_dielectric.h"
#include "materials/surface_material.h"

namespace lampyris {

struct BoundaryParameters {
  RgbInput kr = 1.f, kt = 1.f;
  FloatInput uRoughness = 0, vRoughness = 0;
  bool remapRoughness = true;
  void declareBoundary(Declaration& d) {
    d.add("Kr", kr, "Factor on the reflection.").clamped(0);
    d.add("Kt", kt, "Factor on the transmission.").clamped(0);
    d.add("uroughness", uRoughness, "Roughness along u; smooth if both are 0.").atLeast(0);
    d.add("vroughness", vRoughness, "Roughness along v; smooth if both are 0.").atLeast(0);
    d.add("remaproughness", remapRoughness,
          "Roughness is in [0, 1] and mapped to the microfacets' slope; else it is the slope.");
  }
};

/// Adds one lobe, or none if both colours are black.
inline void addBoundary(const Rgb& kr, const Rgb& kt, const Roughness& roughness, float eta,
                        Bsdf& bsdf) {
  if (kr.isBlack() && kt.isBlack()) return;
  // Without refraction facets bend nothing.
  if (roughness.smooth || isInvisible(eta))
    bsdf.add<SmoothDielectric>(kr, kt, eta);
  else
    bsdf.add<RoughDielectric<>>(kr, kt, roughness.facets, eta);
}

}  // namespace lampyris
