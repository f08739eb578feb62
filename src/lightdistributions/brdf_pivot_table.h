// SPDX-License-Identifier: Apache-2.0
/// What pivot transformed lobe stands for a lobe of Trowbridge–Reitz microfacets.
#pragma once

#include <array>
#include <cstddef>

#include "lightdistributions/brdf_pivot.h"

namespace lampyris {

/// Fitted at nodes of roughness × view angle by the program `fit_lobes`, which writes
/// brdf_pivot_data.inc.
struct PivotFit {
  float albedo;  ///< of the facets: without Fresnel's term, single scattering
  float width;   ///< of the pivot lobe, in relation to meanWidth()
  float lean;    ///< the pivot's angle to the normal over the view angle, − 1
  float error;   ///< ∫ |lobe − fit| over the hemisphere, in relation to the albedo
};

struct PivotTable {
  static constexpr size_t kRoughnesses = 24, kAngles = 32;
  static constexpr float kMinAlpha = 1e-3f, kMaxAlpha = 2.f;
  /// Nodes: √α and the view angle are spaced evenly, but for the last angle, which is 89.1°.
  static float alphaAt(size_t i);
  static float angleAt(size_t j);
  static const std::array<std::array<PivotFit, kAngles>, kRoughnesses>& data();

  /// Bilinear in the nodes; out of range is clamped.
  static PivotFit lookup(float alpha, float viewAngle);
  /// The width to first order in the roughness: facets tilted by δ turn the mirror direction by 2δ
  /// in the plane of incidence and by 2δ cos θ across.
  static float meanWidth(float alpha, float cosView);
};

/// The pivot lobe of facets that lose no light times `factor`, which reflect light towards `wo`;
/// `n` unit, in wo's hemisphere.
PivotLobe reflectionLobe(const Vec3& wo, const Vec3& n, float alpha, float factor);
/// The same for facets that refract, to the side of −n; `eta` as LobeSample::eta. Not fitted: to
/// first order in the roughness.
PivotLobe refractionLobe(const Vec3& wo, const Vec3& n, float alpha, float eta, float factor);

}  // namespace lampyris
