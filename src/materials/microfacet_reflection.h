// SPDX-License-Identifier: Apache-2.0
/// Reflection by microfacets: Torrance and Sparrow 1967, in the form of Walter et al. 2007,
/// "Microfacet Models for Refraction through Rough Surfaces", eq. 20. Weight of a sample:
/// F G / G1 ≤ 1.
#pragma once

#include "base/bsdf.h"
#include "materials/fresnel.h"
#include "materials/trowbridge_reitz.h"

namespace lampyris {

/// `Fresnel` maps a cosine (negative below the surface) to a float or an Rgb.
template <class Fresnel, class Facets = TrowbridgeReitz>
class MicrofacetReflection final : public Lobe {
 public:
  MicrofacetReflection(const Rgb& reflectance, const Facets& facets, const Fresnel& fresnel)
      : Lobe(kReflection | kGlossy), facets_(facets), fresnel_(fresnel) {
    scale = reflectance;
  }

  /// As in pbrt-v3 the directions may lie on different sides of the shading normal.
  Rgb f(const Vec3& wo, const Vec3& wi) const override {
    if (wo.z == 0 || wi.z == 0) return {};
    Vec3 m = normalize(wo + wi);
    if (m == Vec3(0)) return {};
    if (m.z < 0) m = -m;
    return value(wo, wi, m, dot(wi, m));
  }
  float pdf(const Vec3& wo, const Vec3& wi) const override {
    if (!sameHemisphere(wo, wi)) return 0;
    return density(wo, normalize(wo + wi));
  }
  std::optional<LobeSample> sample(const Vec3& wo, float, const Vec2& u) const override {
    const float side = wo.z < 0 ? -1.f : 1.f;
    const Vec3 o = side * wo;
    const Vec3 m = facets_.sampleVisible(o, u);
    const float cosine = dot(o, m);
    const Vec3 i = 2 * cosine * m - o;
    if (!(i.z > 0)) return std::nullopt;
    return LobeSample{side * i, value(o, i, m, side * cosine), density(o, m), flags, 1};
  }
  /// Fresnel's term at the macroscopic angle; facets see others, so it is kept off zero.
  float albedo(const Vec3& wo) const override {
    return std::max((scale * fresnel_(wo.z)).luminance(), 0.01f * scale.luminance());
  }
  size_t shapes(const Vec3& wo, std::span<LobeShape, kMaxShapes> out) const override {
    out[0] = {LobeShape::Kind::Facets, false, albedo(wo), facets_.meanAlpha()};
    return 1;
  }

 private:
  Rgb value(const Vec3& wo, const Vec3& wi, const Vec3& m, float cosine) const {
    return scale * fresnel_(cosine) * (facets_.density(m) * facets_.visibilityOver4Cosines(wo, wi));
  }
  /// Of the reflected direction: the visible normals' D |wo·m| G1 / |cos θo| over 4 |wo·m|.
  float density(const Vec3& wo, const Vec3& m) const {
    return 0.25f * facets_.density(m) * facets_.visibilityOverCosine(wo);
  }
  Facets facets_;
  Fresnel fresnel_;
};

}  // namespace lampyris
