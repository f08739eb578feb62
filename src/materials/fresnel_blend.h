// SPDX-License-Identifier: Apache-2.0
/// A glossy coat over a diffuse base: Ashikhmin and Shirley 2000, "An Anisotropic Phong BRDF
/// Model", eqs. 4–5, with Trowbridge–Reitz facets as in pbrt-v3.
///
/// The model's coat has no masking term, so visible normals would be a poor match for it at grazing
/// angles (unbounded weights). Normals are drawn by D cos θ instead: the coat's weight stays below
/// F / cos θm.
#pragma once

#include "base/bsdf.h"
#include "core/sampling.h"
#include "materials/trowbridge_reitz.h"

namespace lampyris {

class FresnelBlend final : public Lobe {
 public:
  FresnelBlend(const Rgb& diffuse, const Rgb& specular, const TrowbridgeReitz& facets)
      : Lobe(kReflection | kGlossy),
        base_(diffuse * clampPositive(Rgb(1) - specular)),
        specular_(specular),
        facets_(facets) {}

  Rgb f(const Vec3& wo, const Vec3& wi) const override {
    const Vec3 m = normalize(wo + wi);
    if (m == Vec3(0)) return {};
    const Rgb diffuse = base_ * (28 / (23 * kPi) * under(wo) * under(wi));
    const float cosine = absDot(wi, m);
    const float denominator = 4 * cosine * std::max(std::abs(wi.z), std::abs(wo.z));
    return scale * (diffuse + schlick(cosine) * safeDivide(facets_.density(m), denominator));
  }
  float pdf(const Vec3& wo, const Vec3& wi) const override {
    if (!sameHemisphere(wo, wi)) return 0;
    const Vec3 m = normalize(wo + wi);
    const float coat = safeDivide(facets_.density(m) * std::abs(m.z), 4 * absDot(wo, m));
    return lerp(coatProbability(wo), cosineHemispherePdf(std::abs(wi.z)), coat);
  }
  std::optional<LobeSample> sample(const Vec3& wo, float uc, const Vec2& u) const override {
    const float side = wo.z < 0 ? -1.f : 1.f;
    const Vec3 o = side * wo;
    Vec3 i;
    if (uc < coatProbability(wo)) {
      const Vec3 m = facets_.sampleAll(u);
      const float cosine = dot(o, m);
      if (!(cosine > 0)) return std::nullopt;
      i = 2 * cosine * m - o;
    } else {
      i = sampleCosineHemisphere(u);
    }
    if (!(i.z > 0)) return std::nullopt;
    const Vec3 wi = side * i;
    return LobeSample{wi, f(wo, wi), pdf(wo, wi), flags, 1};
  }
  float albedo(const Vec3& wo) const override {
    return scale.luminance() * std::min(1.f, baseAlbedo(wo) + coatAlbedo(wo));
  }
  size_t shapes(const Vec3& wo, std::span<LobeShape, kMaxShapes> out) const override {
    const float size = scale.luminance();
    out[0] = {LobeShape::Kind::Cosine, false, size * baseAlbedo(wo)};
    out[1] = {LobeShape::Kind::Facets, false, size * coatAlbedo(wo), facets_.meanAlpha()};
    return 2;
  }

 private:
  static float pow5(float x) { return sqr(sqr(x)) * x; }
  /// Share of light that passes the coat in this direction, but for a factor.
  static float under(const Vec3& w) { return 1 - pow5(1 - 0.5f * std::abs(w.z)); }
  Rgb schlick(float cosine) const {
    return specular_ + pow5(1 - std::min(cosine, 1.f)) * clampPositive(Rgb(1) - specular_);
  }
  /// Without the constant, which normalises about to 1.
  float baseAlbedo(const Vec3& wo) const { return base_.luminance() * under(wo); }
  float coatAlbedo(const Vec3& wo) const { return schlick(std::abs(wo.z)).luminance(); }
  float coatProbability(const Vec3& wo) const {
    const float base = baseAlbedo(wo), coat = coatAlbedo(wo);
    if (!(base > 0)) return 1;
    // Never too sure: facets see angles that the macroscopic one doesn't tell.
    return std::clamp(coat / (base + coat), 0.1f, 0.9f);
  }

  Rgb base_, specular_;
  TrowbridgeReitz facets_;
};

}  // namespace lampyris
