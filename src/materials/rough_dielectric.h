// SPDX-License-Identifier: Apache-2.0
/// Reflection and refraction by dielectric microfacets: Walter et al. 2007, "Microfacet Models for
/// Refraction through Rough Surfaces", eqs. 17–21, with visible normals. A facet is drawn, then
/// reflection or refraction in proportion to Fresnel's share there times the colour.
///
/// Deviation from pbrt-v3: light that would refract through the back of a facet counts as blocked
/// (eq. 21 and the χ+ of G); v3 lets light sampling, but not BSDF sampling, see some.
#pragma once

#include "base/bsdf.h"
#include "materials/fresnel.h"
#include "materials/trowbridge_reitz.h"

namespace lampyris {

/// True if the index is so near 1 that the half vector of refraction drowns in rounding errors:
/// light passes straight on then, within a milliradian, and a SmoothDielectric is to be used.
inline bool isInvisible(float eta) { return std::abs(eta - 1) < 1e-3f; }

/// `eta`: index below the surface in relation to above, not nearly 1. Either colour may be black.
template <class Facets = TrowbridgeReitz>
class RoughDielectric final : public Lobe {
 public:
  RoughDielectric(const Rgb& reflectance, const Rgb& transmittance, const Facets& facets, float eta)
      : Lobe(static_cast<uint8_t>(kGlossy | (reflectance.isBlack() ? 0 : kReflection) |
                                  (transmittance.isBlack() ? 0 : kTransmission))),
        reflectance_(reflectance),
        transmittance_(transmittance),
        facets_(facets),
        eta_(eta) {}

  Rgb f(const Vec3& wo, const Vec3& wi) const override {
    const auto e = event(wo, wi);
    return e ? value(*e) : Rgb();
  }
  float pdf(const Vec3& wo, const Vec3& wi) const override {
    const auto e = event(wo, wi);
    return e ? density(*e) : 0.f;
  }
  std::optional<LobeSample> sample(const Vec3& wo, float uc, const Vec2& u) const override {
    if (wo.z == 0) return std::nullopt;
    const float side = wo.z < 0 ? -1.f : 1.f;
    Event e;
    e.o = side * wo;
    e.m = facets_.sampleVisible(e.o, u);
    e.eta = wo.z > 0 ? eta_ : 1 / eta_;
    e.cosO = dot(e.o, e.m);
    if (!(e.cosO > 0)) return std::nullopt;
    e.fresnel = fresnelDielectric(e.cosO, e.eta);
    const float p = reflectionProbability(e.fresnel);
    e.reflected = uc < p;
    if (e.reflected) {
      e.i = 2 * e.cosO * e.m - e.o;
      if (!(e.i.z > 0)) return std::nullopt;
    } else {
      const float sin2T = (1 - std::min(sqr(e.cosO), 1.f)) / sqr(e.eta);
      if (sin2T >= 1) return std::nullopt;
      e.i = normalize((e.cosO / e.eta - std::sqrt(1 - sin2T)) * e.m - e.o / e.eta);
      e.cosI = dot(e.i, e.m);
      if (!(e.i.z < 0) || !(e.cosI < 0)) return std::nullopt;
    }
    return LobeSample{side * e.i, value(e), density(e),
                      static_cast<uint8_t>(kGlossy | (e.reflected ? kReflection : kTransmission)),
                      e.reflected ? 1.f : e.eta};
  }
  float albedo(const Vec3& wo) const override {
    const auto [reflected, transmitted] = albedos(wo);
    return reflected + transmitted;
  }
  size_t shapes(const Vec3& wo, std::span<LobeShape, kMaxShapes> out) const override {
    const auto [reflected, transmitted] = albedos(wo);
    const float alpha = facets_.meanAlpha(), eta = wo.z > 0 ? eta_ : 1 / eta_;
    size_t count = 0;
    if (reflected > 0) out[count++] = {LobeShape::Kind::Facets, false, reflected, alpha};
    if (transmitted > 0) out[count++] = {LobeShape::Kind::Facets, true, transmitted, alpha, eta};
    return count;
  }

 private:
  struct Albedos {
    float reflected, transmitted;
  };
  /// Shares at the macroscopic angle; facets see others, so they are kept off zero.
  Albedos albedos(const Vec3& wo) const {
    const float fresnel = fresnelDielectric(wo.z, eta_);
    return {(scale * reflectance_ * std::max(fresnel, 0.01f)).luminance(),
            (scale * transmittance_ * std::max(1 - fresnel, 0.01f)).luminance()};
  }

  /// One facet at work, turned so that wo is above the surface.
  struct Event {
    Vec3 o{0}, i{0}, m{0};
    float cosO = 0, cosI = 0;  ///< with m; cosI < 0, and only set, if refracted
    float eta = 1;             ///< on the side of i in relation to the side of o
    float fresnel = 0;
    bool reflected = true;
  };

  /// The facet that sends wi to wo, if there is one.
  std::optional<Event> event(const Vec3& wo, const Vec3& wi) const {
    if (wo.z == 0 || wi.z == 0) return std::nullopt;
    const float side = wo.z < 0 ? -1.f : 1.f;
    Event e;
    e.o = side * wo;
    e.i = side * wi;
    e.eta = wo.z > 0 ? eta_ : 1 / eta_;
    e.reflected = e.i.z > 0;
    if ((e.reflected ? reflectance_ : transmittance_).isBlack()) return std::nullopt;
    e.m = normalize(e.reflected ? e.o + e.i : e.o + e.eta * e.i);
    if (e.m.z < 0) e.m = -e.m;
    e.cosO = dot(e.o, e.m);
    e.cosI = dot(e.i, e.m);
    if (!(e.cosO > 0) || (!e.reflected && !(e.cosI < 0))) return std::nullopt;
    e.fresnel = fresnelDielectric(e.cosO, e.eta);
    return e;
  }
  float reflectionProbability(float fresnel) const {
    const float r = fresnel * reflectance_.luminance();
    const float t = (1 - fresnel) * transmittance_.luminance();
    return r > 0 ? r / (r + t) : 0.f;
  }
  Rgb value(const Event& e) const {
    const float common = facets_.density(e.m) * facets_.visibilityOver4Cosines(e.o, e.i);
    if (e.reflected) return scale * reflectance_ * (e.fresnel * common);
    // The Jacobian's η² and the 1/η² of radiance cancel.
    const float jacobian = e.cosO * -e.cosI / sqr(e.cosO + e.eta * e.cosI);
    return scale * transmittance_ * ((1 - e.fresnel) * 4 * common * jacobian);
  }
  float density(const Event& e) const {
    const float facet = facets_.density(e.m) * facets_.visibilityOverCosine(e.o);
    const float p = reflectionProbability(e.fresnel);
    if (e.reflected) return p * facet / 4;
    return (1 - p) * facet * e.cosO * -e.cosI * sqr(e.eta / (e.cosO + e.eta * e.cosI));
  }

  Rgb reflectance_, transmittance_;
  Facets facets_;
  float eta_;
};

}  // namespace lampyris
