// SPDX-License-Identifier: Apache-2.0
/// The lobes that only the "disney" material has: Burley 2012, "Physically-Based Shading at
/// Disney", §5, and Burley 2015, "Extending the Disney BRDF to a BSDF with Integrated Subsurface
/// Scattering", in the form that pbrt-v3 gives them.
#pragma once

#include "materials/cosine_sampling.h"
#include "materials/fresnel.h"
#include "materials/trowbridge_reitz.h"

namespace lampyris {

/// Schlick's weight of grazing angles, (1 − cos θ)⁵.
inline float schlickWeight(float cosine) {
  const float m = std::clamp(1 - cosine, 0.f, 1.f);
  return sqr(sqr(m)) * m;
}

/// What a surface scatters back without mirroring: four terms with a colour each. All draw from the
/// cosine, so one lobe is enough for them.
class DisneyBase final : public Lobe {
 public:
  struct Colors {
    Rgb diffuse, flat;  ///< Burley 2012, §5.3, and its flat version for thin subsurface scattering
    Rgb retro;          ///< retro-reflection of rough surfaces
    Rgb sheen;          ///< of cloth, at grazing angles
  };
  DisneyBase(const Colors& colors, float roughness)
      : Lobe(kReflection | kDiffuse), colors_(colors), roughness_(roughness) {}

  Rgb f(const Vec3& wo, const Vec3& wi) const override {
    const Vec3 m = normalize(wo + wi);
    // cos² of half the angle between the directions.
    const float halfAngle2 = sqr(dot(wi, m));
    const float o = schlickWeight(std::abs(wo.z)), i = schlickWeight(std::abs(wi.z));
    const float retro = 2 * roughness_ * halfAngle2;
    Rgb sum = colors_.diffuse * (kInvPi * (1 - o / 2) * (1 - i / 2));
    if (m != Vec3(0)) {
      sum += colors_.retro * (kInvPi * retro * (o + i + o * i * (retro - 1)));
      sum += colors_.sheen * schlickWeight(std::sqrt(halfAngle2));
      if (!colors_.flat.isBlack()) sum += colors_.flat * (kInvPi * flat(wo, wi, o, i, retro / 2));
    }
    return scale * sum;
  }
  float pdf(const Vec3& wo, const Vec3& wi) const override { return cosinePdf(sideOf(wo), wi); }
  std::optional<LobeSample> sample(const Vec3& wo, float, const Vec2& u) const override {
    return sampleCosine(*this, sideOf(wo), wo, u);
  }
  /// Sheen and retro-reflection lie at grazing angles: a part of their colour stands for them.
  float albedo(const Vec3&) const override {
    return (scale * (colors_.diffuse + colors_.flat + 0.1f * (colors_.retro + colors_.sheen)))
        .luminance();
  }

 private:
  /// After Hanrahan and Krueger 1993; `most` is the reflectance at 90° in relation to 0°.
  static float flat(const Vec3& wo, const Vec3& wi, float o, float i, float most) {
    const float cosines = std::abs(wo.z) + std::abs(wi.z);
    if (!(cosines > 0)) return 0;
    return 1.25f * (lerp(o, 1, most) * lerp(i, 1, most) * (1 / cosines - 0.5f) + 0.5f);
  }
  Colors colors_;
  float roughness_;
};

/// Fresnel's term between a dielectric's and Schlick's for `metallic`.
struct DisneyFresnel {
  Rgb normalReflectance;
  float metallic, eta;
  Rgb operator()(float cosI) const {
    const Rgb schlick = lerp(schlickWeight(cosI), normalReflectance, Rgb(1));
    return lerp(metallic, Rgb(fresnelDielectric(cosI, eta)), schlick);
  }
};

/// The second, colourless coat: GTR facets with exponent 1 (Burley 2012, appendix B.2), masking of
/// a fixed roughness, Fresnel's term of index 1.5 after Schlick.
class DisneyClearcoat final : public Lobe {
 public:
  /// `gloss` in [0, 1] makes the facets' roughness fall from 0.1 to 0.001.
  DisneyClearcoat(float weight, float gloss)
      : Lobe(kReflection | kGlossy), alpha2_(sqr(lerp(gloss, 0.1f, 0.001f))) {
    scale = Rgb(weight);
  }
  Rgb f(const Vec3& wo, const Vec3& wi) const override {
    const Vec3 m = normalize(wo + wi);
    if (m == Vec3(0)) return {};
    const float fresnel = lerp(schlickWeight(dot(wo, m)), 0.04f, 1);
    return scale * (0.25f * fresnel * density(m) * masking(wo) * masking(wi));
  }
  float pdf(const Vec3& wo, const Vec3& wi) const override {
    if (!sameHemisphere(wo, wi)) return 0;
    const Vec3 m = normalize(wo + wi);
    return safeDivide(density(m) * std::abs(m.z), 4 * dot(wo, m));
  }
  std::optional<LobeSample> sample(const Vec3& wo, float, const Vec2& u) const override {
    const float side = sideOf(wo);
    const float z = safeSqrt((1 - std::pow(alpha2_, 1 - u.x)) / (1 - alpha2_));
    const Vec3 m = sphericalDirection(std::sqrt(std::max(0.f, 1 - z * z)), z, 2 * kPi * u.y) * side;
    const float cosine = dot(wo, m);
    if (!(cosine > 0)) return std::nullopt;
    const Vec3 wi = 2 * cosine * m - wo;
    if (!sameHemisphere(wo, wi)) return std::nullopt;
    const float p = pdf(wo, wi);
    if (!(p > 0)) return std::nullopt;
    return LobeSample{wi, f(wo, wi), p, flags, 1};
  }
  float albedo(const Vec3& wo) const override {
    return scale.luminance() * 0.25f * lerp(schlickWeight(std::abs(wo.z)), 0.04f, 1);
  }
  /// Its core and its tail: two Trowbridge-Reitz lobes of half the albedo, whose median tilts are
  /// the quartiles of these facets'. Up to a tilt θ there are 1 − ln(α² + (1 − α²) sin²θ) / ln α²
  /// of these, tan²θ / (α² + tan²θ) of those.
  size_t shapes(const Vec3& wo, std::span<LobeShape, kMaxShapes> out) const override {
    const float root = std::sqrt(std::sqrt(alpha2_));  // α^½
    for (size_t i = 0; i < 2; ++i) {
      const float e = i == 0 ? root * root * root : root;
      const float alpha = std::sqrt((e - alpha2_) / (1 - e));
      out[i] = {LobeShape::Kind::Facets, false, 0.5f * albedo(wo), alpha};
    }
    return 2;
  }

 private:
  /// By solid angle of m, times cos θ a density over the hemisphere.
  float density(const Vec3& m) const {
    const float d = alpha2_ - 1;
    // 1 + d cos²θ, without the cancellation next to the normal.
    const float e = alpha2_ + (1 - alpha2_) * (sqr(m.x) + sqr(m.y));
    return d / (kPi * std::log(alpha2_) * e);
  }
  static float masking(const Vec3& w) {
    constexpr float kAlpha2 = sqr(0.25f);
    const float c = std::abs(w.z);
    return 1 / (c + std::sqrt(kAlpha2 + (1 - kAlpha2) * c * c));
  }
  float alpha2_;
};

}  // namespace lampyris
