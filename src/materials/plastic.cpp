// SPDX-License-Identifier: Apache-2.0
#include "materials/lambert.h"
#include "materials/microfacet_reflection.h"
#include "materials/roughness.h"
#include "materials/surface_material.h"

namespace lampyris {
namespace {

struct PlasticParameters : SurfaceParameters {
  RgbInput kd = 0.25f, ks = 0.25f;
  FloatInput roughness = 0.1f;
  bool remapRoughness = true;
  void declare(Declaration& d) {
    d.add("Kd", kd, "Diffuse reflectance.").clamped(0);
    d.add("Ks", ks, "Factor on the glossy reflection.").clamped(0);
    d.add("roughness", roughness, "Roughness of the glossy reflection.").atLeast(0);
    d.add("remaproughness", remapRoughness,
          "Roughness is in [0, 1] and mapped to the microfacets' slope; else it is the slope.");
    declareSurface(d);
  }
};

class PlasticMaterial final : public SurfaceMaterial {
 public:
  PlasticMaterial(const PlasticParameters& p, const MaterialContext& c)
      : SurfaceMaterial(p, c),
        kd_(input(c, p.kd)),
        ks_(input(c, p.ks)),
        roughness_(input(c, p.roughness), p.remapRoughness) {}

  size_t maxLobes() const override { return 2; }
  void addLobes(const SurfaceInteraction& at, Bsdf& bsdf) const override {
    const Rgb kd = reflectance(kd_(at)), ks = reflectance(ks_(at));
    if (!kd.isBlack()) bsdf.add<LambertReflection>(kd);
    if (ks.isBlack()) return;
    // pbrt-v3 has the dense medium on the outside: reflection is total beyond 42°.
    constexpr DielectricFresnel kFresnel{1 / 1.5f};
    bsdf.add<MicrofacetReflection<DielectricFresnel>>(ks, roughness_(at).facets, kFresnel);
  }

 private:
  TexturedRgb kd_, ks_;
  RoughnessInput roughness_;
};

}  // namespace

MaterialRegistry::Entry plasticPlugin() {
  return makePlugin("plastic", "Diffuse reflection and a white glossy one.",
                    createMaterial<PlasticMaterial, PlasticParameters>);
}

}  // namespace lampyris
