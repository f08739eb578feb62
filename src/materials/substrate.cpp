// SPDX-License-Identifier: Apache-2.0
#include "materials/fresnel_blend.h"
#include "materials/roughness.h"
#include "materials/surface_material.h"

namespace lampyris {
namespace {

struct SubstrateParameters : SurfaceParameters {
  RgbInput kd = 0.5f, ks = 0.5f;
  FloatInput uRoughness = 0.1f, vRoughness = 0.1f;
  bool remapRoughness = true;
  void declare(Declaration& d) {
    d.add("Kd", kd, "Diffuse reflectance of the base.").clamped(0);
    d.add("Ks", ks, "Reflectance of the coat from above.").clamped(0);
    d.add("uroughness", uRoughness, "Roughness of the coat along u.").atLeast(0);
    d.add("vroughness", vRoughness, "Roughness of the coat along v.").atLeast(0);
    d.add("remaproughness", remapRoughness,
          "Roughness is in [0, 1] and mapped to the microfacets' slope; else it is the slope.");
    declareSurface(d);
  }
};

class SubstrateMaterial final : public SurfaceMaterial {
 public:
  SubstrateMaterial(const SubstrateParameters& p, const MaterialContext& c)
      : SurfaceMaterial(p, c),
        kd_(input(c, p.kd)),
        ks_(input(c, p.ks)),
        roughness_(input(c, p.uRoughness), input(c, p.vRoughness), p.remapRoughness) {}

  void addLobes(const SurfaceInteraction& at, Bsdf& bsdf) const override {
    const Rgb kd = reflectance(kd_(at)), ks = reflectance(ks_(at));
    if (!kd.isBlack() || !ks.isBlack()) bsdf.add<FresnelBlend>(kd, ks, roughness_(at).facets);
  }

 private:
  TexturedRgb kd_, ks_;
  RoughnessInput roughness_;
};

}  // namespace

MaterialRegistry::Entry substratePlugin() {
  return makePlugin("substrate", "Diffuse base under a glossy coat.",
                    createMaterial<SubstrateMaterial, SubstrateParameters>);
}

}  // namespace lampyris
