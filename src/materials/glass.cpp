// SPDX-License-Identifier: Apache-2.0
#include "materials/rough_dielectric.h"
#include "materials/roughness.h"
#include "materials/smooth_dielectric.h"
#include "materials/surface_material.h"

namespace lampyris {
namespace {

struct GlassParameters : SurfaceParameters {
  RgbInput kr = 1.f, kt = 1.f;
  FloatInput eta = 1.5f, uRoughness = 0, vRoughness = 0;
  bool remapRoughness = true;
  void declare(Declaration& d) {
    d.add("Kr", kr, "Factor on the reflection.");
    d.add("Kt", kt, "Factor on the transmission.");
    d.add("eta", eta, "Index of refraction inside.").alias("index").range(kMinEta, kMaxEta);
    d.add("uroughness", uRoughness, "Roughness along u; smooth if both are 0.").atLeast(0);
    d.add("vroughness", vRoughness, "Roughness along v; smooth if both are 0.").atLeast(0);
    d.add("remaproughness", remapRoughness,
          "Roughness is in [0, 1] and mapped to the microfacets' slope; else it is the slope.");
    declareSurface(d);
  }
};

class GlassMaterial final : public SurfaceMaterial {
 public:
  GlassMaterial(const GlassParameters& p, const MaterialContext& c)
      : SurfaceMaterial(p, c),
        kr_(input(c, p.kr)),
        kt_(input(c, p.kt)),
        eta_(input(c, p.eta)),
        roughness_(input(c, p.uRoughness), input(c, p.vRoughness), p.remapRoughness) {}

  void addLobes(const SurfaceInteraction& at, Bsdf& bsdf) const override {
    const Rgb kr = reflectance(kr_(at)), kt = reflectance(kt_(at));
    if (kr.isBlack() && kt.isBlack()) return;
    const Roughness roughness = roughness_(at);
    const float eta = refractiveIndex(eta_(at));
    // Without refraction facets bend nothing.
    if (roughness.smooth || isInvisible(eta))
      bsdf.add<SmoothDielectric>(kr, kt, eta);
    else
      bsdf.add<RoughDielectric<>>(kr, kt, roughness.facets, eta);
  }

 private:
  TexturedRgb kr_, kt_;
  TexturedFloat eta_;
  RoughnessInput roughness_;
};

}  // namespace

MaterialRegistry::Entry glassPlugin() {
  return makePlugin("glass", "Dielectric, smooth or rough.",
                    createMaterial<GlassMaterial, GlassParameters>);
}

}  // namespace lampyris
