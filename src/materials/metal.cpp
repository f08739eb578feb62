// SPDX-License-Identifier: Apache-2.0
#include "materials/microfacet_reflection.h"
#include "materials/roughness.h"
#include "materials/surface_material.h"

namespace lampyris {
namespace {

/// Copper's spectra, as pbrt-v3's conversion to RGB gives them.
constexpr Rgb kCopperEta(0.19999069f, 0.92208463f, 1.09987593f);
constexpr Rgb kCopperK(3.90463543f, 2.44763327f, 2.13765264f);

struct MetalParameters : SurfaceParameters {
  RgbInput eta = kCopperEta, k = kCopperK;
  FloatInput roughness = 0.01f;
  std::optional<FloatInput> uRoughness, vRoughness;
  bool remapRoughness = true;
  void declare(Declaration& d) {
    d.add("eta", eta, "Index of refraction.").defaultIs("copper's").clamped(0);
    d.add("k", k, "Absorption coefficient, the index's imaginary part.")
        .defaultIs("copper's")
        .clamped(0);
    d.add("roughness", roughness, "Roughness in both directions.").atLeast(0);
    d.add("uroughness", uRoughness, "Roughness along u, instead of \"roughness\".").atLeast(0);
    d.add("vroughness", vRoughness, "Roughness along v, instead of \"roughness\".").atLeast(0);
    d.add("remaproughness", remapRoughness,
          "Roughness is in [0, 1] and mapped to the microfacets' slope; else it is the slope.");
    declareSurface(d);
  }
};

class MetalMaterial final : public SurfaceMaterial {
 public:
  MetalMaterial(const MetalParameters& p, const MaterialContext& c)
      : SurfaceMaterial(p, c),
        eta_(input(c, p.eta)),
        k_(input(c, p.k)),
        roughness_(resolveRoughness(p, c)) {}

  void addLobes(const SurfaceInteraction& at, Bsdf& bsdf) const override {
    // The same bounds as of a reflectance keep Fresnel's formula finite.
    const ConductorFresnel fresnel{reflectance(eta_(at)), reflectance(k_(at))};
    bsdf.add<MicrofacetReflection<ConductorFresnel>>(Rgb(1), roughness_(at).facets, fresnel);
  }

 private:
  RoughnessInput resolveRoughness(const MetalParameters& p, const MaterialContext& c) {
    // Not resolved where both directions have their own: an unused texture is no reason to filter.
    const TexturedFloat both =
        p.uRoughness && p.vRoughness ? TexturedFloat{} : input(c, p.roughness);
    return {input(c, p.uRoughness, both), input(c, p.vRoughness, both), p.remapRoughness};
  }
  TexturedRgb eta_, k_;
  RoughnessInput roughness_;
};

}  // namespace

MaterialRegistry::Entry metalPlugin() {
  return makePlugin("metal", "Rough conductor, copper by default.",
                    createMaterial<MetalMaterial, MetalParameters>);
}

}  // namespace lampyris
