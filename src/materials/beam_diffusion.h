// SPDX-License-Identifier: Apache-2.0
/// How far from where a thin beam enters a half-space of scattering medium light leaves it: photon
/// beam diffusion (Habel et al. 2013, "Photon Beam Diffusion: A Hybrid Monte Carlo Method for
/// Subsurface Scattering"), with single scattering by itself. For any beam that enters by
/// Fresnel's law the one at normal incidence stands.
#pragma once

#include "materials/catmull_rom.h"

namespace lampyris {

/// Radiant exitance around a beam of unit power, of media with extinction 1.
class BeamDiffusion {
 public:
  /// Anisotropy g in (−1, 1), index of refraction eta ≥ 1.
  BeamDiffusion(double g, double eta);
  /// At distance r ≥ 0, of light that scattered more than once.
  double multiple(double albedo, double r) const;
  /// At distance r > 0, of light that scattered once.
  double single(double albedo, double r) const;

 private:
  double g_, eta_;
  /// ∫ F(cos θ) cosᵏθ d cos θ over [0, 1] of Fresnel's reflectance from inside.
  double firstMoment_, secondMoment_;
};

/// The profile 2π r R(r) by albedo and distance, with pbrt-v3's nodes: 100 albedos, 64 distances up
/// to about 200 mean free paths.
class DiffusionTable {
 public:
  DiffusionTable(float g, float eta);

  /// By distance in mean free paths; integrates to the effective albedo.
  SplineGrid::Row profile(float albedo) const;
  /// The single-scattering albedo of a medium that reflects this share of light in all.
  float albedoOfReflectance(float reflectance) const;

 private:
  SplineGrid profiles_;
  std::vector<float> effective_;
};

}  // namespace lampyris
