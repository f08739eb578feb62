// SPDX-License-Identifier: Apache-2.0
#include "materials/lambert.h"
#include "materials/microfacet_reflection.h"
#include "materials/roughness.h"
#include "materials/smooth_dielectric.h"
#include "materials/surface_material.h"

namespace lampyris {
namespace {

struct UberParameters : SurfaceParameters {
  RgbInput kd = 0.25f, ks = 0.25f, kr = 0.f, kt = 0.f, opacity = 1.f;
  FloatInput roughness = 0.1f, eta = 1.5f;
  std::optional<FloatInput> uRoughness, vRoughness;
  bool remapRoughness = true;
  void declare(Declaration& d) {
    d.add("Kd", kd, "Diffuse reflectance.").clamped(0);
    d.add("Ks", ks, "Factor on the glossy reflection.").clamped(0);
    d.add("Kr", kr, "Factor on the mirror reflection.").clamped(0);
    d.add("Kt", kt, "Factor on the refraction.").clamped(0);
    d.add("opacity", opacity, "1 minus the share of light that passes straight on.").clamped(0);
    d.add("eta", eta, "Index of refraction inside.").alias("index").range(kMinEta, kMaxEta);
    d.add("roughness", roughness, "Roughness of the glossy reflection.").atLeast(0);
    d.add("uroughness", uRoughness, "Roughness along u, instead of \"roughness\".").atLeast(0);
    d.add("vroughness", vRoughness, "Roughness along v, instead of the one along u.").atLeast(0);
    d.add("remaproughness", remapRoughness,
          "Roughness is in [0, 1] and mapped to the microfacets' slope; else it is the slope.");
    declareSurface(d);
  }
};

class UberMaterial final : public SurfaceMaterial {
 public:
  UberMaterial(const UberParameters& p, const MaterialContext& c)
      : SurfaceMaterial(p, c),
        kd_(input(c, p.kd)),
        ks_(input(c, p.ks)),
        kr_(input(c, p.kr)),
        kt_(input(c, p.kt)),
        opacity_(input(c, p.opacity)),
        eta_(input(c, p.eta)),
        roughness_(resolveRoughness(p, c)) {}

  size_t maxLobes() const override {
    const auto present = [](const TexturedRgb& t) {
      return !t.isConstant() || !reflectance(t.value).isBlack();
    };
    const bool passes = !opacity_.isConstant() || !(Rgb(1) == opacity_.value);
    return size_t{present(kd_)} + present(ks_) + (present(kr_) || present(kt_)) + passes;
  }
  void addLobes(const SurfaceInteraction& at, Bsdf& bsdf) const override {
    const Rgb opacity = reflectance(opacity_(at));
    const Rgb passing = clampPositive(Rgb(1) - opacity);
    if (!passing.isBlack()) bsdf.add<SmoothDielectric>(Rgb(), passing, 1.f);
    const Rgb kd = opacity * reflectance(kd_(at)), ks = opacity * reflectance(ks_(at));
    const Rgb kr = opacity * reflectance(kr_(at)), kt = opacity * reflectance(kt_(at));
    if (!kd.isBlack()) bsdf.add<LambertReflection>(kd);
    const float eta = refractiveIndex(eta_(at));
    if (!ks.isBlack())
      bsdf.add<MicrofacetReflection<DielectricFresnel>>(ks, roughness_(at).facets,
                                                        DielectricFresnel{eta});
    if (!kr.isBlack() || !kt.isBlack()) bsdf.add<SmoothDielectric>(kr, kt, eta);
  }

 private:
  RoughnessInput resolveRoughness(const UberParameters& p, const MaterialContext& c) {
    const TexturedFloat u = input(c, p.uRoughness.value_or(p.roughness));
    return {u, input(c, p.vRoughness, u), p.remapRoughness};
  }
  TexturedRgb kd_, ks_, kr_, kt_, opacity_;
  TexturedFloat eta_;
  RoughnessInput roughness_;
};

}  // namespace

MaterialRegistry::Entry uberPlugin() {
  return makePlugin("uber", "Diffuse, glossy and mirror reflection, refraction and opacity.",
                    createMaterial<UberMaterial, UberParameters>);
}

}  // namespace lampyris
