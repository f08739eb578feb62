// SPDX-License-Identifier: Apache-2.0
#include "materials/lambert.h"
#include "materials/rough_dielectric.h"
#include "materials/roughness.h"
#include "materials/surface_material.h"

namespace lampyris {
namespace {

struct TranslucentParameters : SurfaceParameters {
  RgbInput kd = 0.25f, ks = 0.25f, reflect = 0.5f, transmit = 0.5f;
  FloatInput roughness = 0.1f;
  bool remapRoughness = true;
  void declare(Declaration& d) {
    d.add("Kd", kd, "Factor on diffuse scattering.").clamped(0);
    d.add("Ks", ks, "Factor on glossy scattering.").clamped(0);
    d.add("reflect", reflect, "Share that is reflected.").clamped(0);
    d.add("transmit", transmit, "Share that is transmitted.").clamped(0);
    d.add("roughness", roughness, "Roughness of the glossy scattering.").atLeast(0);
    d.add("remaproughness", remapRoughness,
          "Roughness is in [0, 1] and mapped to the microfacets' slope; else it is the slope.");
    declareSurface(d);
  }
};

class TranslucentMaterial final : public SurfaceMaterial {
 public:
  TranslucentMaterial(const TranslucentParameters& p, const MaterialContext& c)
      : SurfaceMaterial(p, c),
        kd_(input(c, p.kd)),
        ks_(input(c, p.ks)),
        reflect_(input(c, p.reflect)),
        transmit_(input(c, p.transmit)),
        roughness_(input(c, p.roughness), p.remapRoughness) {}

  size_t maxLobes() const override { return 3; }
  void addLobes(const SurfaceInteraction& at, Bsdf& bsdf) const override {
    const Rgb r = reflectance(reflect_(at)), t = reflectance(transmit_(at));
    if (r.isBlack() && t.isBlack()) return;
    const Rgb kd = reflectance(kd_(at)), ks = reflectance(ks_(at));
    const Rgb diffuseR = r * kd, diffuseT = t * kd, glossyR = r * ks, glossyT = t * ks;
    constexpr float kEta = 1.5f;
    if (!diffuseR.isBlack()) bsdf.add<LambertReflection>(diffuseR);
    if (!diffuseT.isBlack()) bsdf.add<LambertTransmission>(diffuseT);
    if (!glossyR.isBlack() || !glossyT.isBlack())
      bsdf.add<RoughDielectric<>>(glossyR, glossyT, roughness_(at).facets, kEta);
  }

 private:
  TexturedRgb kd_, ks_, reflect_, transmit_;
  RoughnessInput roughness_;
};

}  // namespace

MaterialRegistry::Entry translucentPlugin() {
  return makePlugin("translucent", "Diffuse and glossy, reflected and transmitted.",
                    createMaterial<TranslucentMaterial, TranslucentParameters>);
}

}  // namespace lampyris
