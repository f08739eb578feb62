// SPDX-License-Identifier: Apache-2.0
#include "materials/disney_lobes.h"
#include "materials/lambert.h"
#include "materials/microfacet_reflection.h"
#include "materials/rough_dielectric.h"
#include "materials/separable_bssrdf.h"
#include "materials/smooth_dielectric.h"
#include "materials/surface_material.h"

namespace lampyris {
namespace {

struct DisneyParameters : SurfaceParameters {
  RgbInput color = 0.5f, scatterDistance = 0.f;
  FloatInput metallic = 0, eta = 1.5f, roughness = 0.5f, specularTint = 0, anisotropic = 0;
  FloatInput sheen = 0, sheenTint = 0.5f, clearcoat = 0, clearcoatGloss = 1, specTrans = 0;
  FloatInput flatness = 0, diffTrans = 1;
  bool thin = false;
  void declare(Declaration& d) {
    d.add("color", color, "Base colour.").clamped(0);
    d.add("metallic", metallic, "0: dielectric, 1: metal.").clamped(0, 1);
    d.add("eta", eta, "Index of refraction inside.").range(kMinEta, kMaxEta);
    d.add("roughness", roughness, "Roughness, in [0, 1]; the microfacets' slope is its square.")
        .clamped(0);
    d.add("speculartint", specularTint, "How much of the base colour the reflection has.")
        .clamped(0, 1);
    d.add("anisotropic", anisotropic, "0: alike in all directions, 1: a highlight along u.")
        .clamped(0, 1);
    d.add("sheen", sheen, "Reflection of cloth at grazing angles.").clamped(0);
    d.add("sheentint", sheenTint, "How much of the base colour the sheen has.").clamped(0, 1);
    d.add("clearcoat", clearcoat, "Factor on a second, colourless coat.").clamped(0);
    d.add("clearcoatgloss", clearcoatGloss, "Its gloss: 0 is satin, 1 is shiny.").clamped(0, 1);
    d.add("spectrans", specTrans, "Share of light that is refracted instead of diffused.")
        .clamped(0, 1);
    d.add("scatterdistance", scatterDistance,
          "About how far light goes below the surface, in the scene's unit of length; black: no "
          "subsurface scattering.")
        .clamped(0);
    d.add("thin", thin, "The surface is a thin sheet: no subsurface scattering, light passes.");
    d.add("flatness", flatness, "Of a thin sheet: share of a flatter diffuse reflection.")
        .clamped(0, 1);
    d.add("difftrans", diffTrans,
          "Of a thin sheet: diffuse transmission; 0 all is reflected, 1 half, 2 none.")
        .clamped(0, 2);
    declareSurface(d);
  }
};

/// A weight; textures may stray.
float share(float v) { return std::min(1.f, std::max(0.f, v)); }

/// The material's values at a point.
struct Appearance {
  Rgb color, tint;  ///< tint: the colour without its luminance
  float metallic, eta, roughness, anisotropic, diffuse;

  SeparableTrowbridgeReitz facets(float rough) const {
    const float aspect = std::sqrt(1 - 0.9f * anisotropic);
    return {sqr(rough) / aspect, sqr(rough) * aspect};
  }
};

class DisneyMaterial final : public SurfaceMaterial {
 public:
  DisneyMaterial(const DisneyParameters& p, const MaterialContext& c)
      : SurfaceMaterial(p, c),
        color_(input(c, p.color)),
        metallic_(input(c, p.metallic)),
        eta_(input(c, p.eta)),
        roughness_(input(c, p.roughness)),
        specularTint_(input(c, p.specularTint)),
        anisotropic_(input(c, p.anisotropic)),
        sheen_(input(c, p.sheen)),
        sheenTint_(input(c, p.sheenTint)),
        clearcoat_(input(c, p.clearcoat)),
        clearcoatGloss_(input(c, p.clearcoatGloss)),
        specTrans_(input(c, p.specTrans)),
        flatness_(input(c, p.flatness)),
        diffTrans_(input(c, p.diffTrans)),
        thin_(p.thin) {
    if (!thin_) scatterDistance_ = input(c, p.scatterDistance);
  }

  bool scattersBelow() const override {
    return !scatterDistance_.isConstant() || !scatterDistance_.value.isBlack();
  }
  const Bssrdf* bssrdf(const SurfaceInteraction& at, BssrdfStorage& storage) const override {
    const Appearance a = appearance(at, share(specTrans_(at)));
    const Rgb distance = reflectance(scatterDistance_(at));
    if (!(a.diffuse > 0) || distance.isBlack()) return nullptr;
    return storage.make<BurleyBssrdf>(a.diffuse * a.color, distance, a.eta);
  }
  size_t maxLobes() const override { return 5; }
  void addLobes(const SurfaceInteraction& at, Bsdf& bsdf) const override {
    const float transmitted = share(specTrans_(at));
    const Appearance a = appearance(at, transmitted);
    const float thinTransmission = thin_ ? share(diffTrans_(at) / 2) : 0.f;
    addBase(at, a, thinTransmission, bsdf);
    addReflections(at, a, bsdf);
    if (transmitted > 0) addRefraction(a, transmitted, bsdf);
    if (thinTransmission > 0 && !a.color.isBlack())
      bsdf.add<LambertTransmission>(thinTransmission * a.color);
  }

 private:
  Appearance appearance(const SurfaceInteraction& at, float transmitted) const {
    Appearance a;
    a.color = reflectance(color_(at));
    const float luminance = a.color.luminance();
    a.tint = luminance > 0 ? a.color / luminance : Rgb(1);
    a.metallic = share(metallic_(at));
    a.eta = refractiveIndex(eta_(at));
    a.roughness = reflectance(Rgb(roughness_(at))).r;
    a.anisotropic = share(anisotropic_(at));
    a.diffuse = (1 - a.metallic) * (1 - transmitted);
    return a;
  }
  /// Subsurface scattering takes the place of the diffuse term: light enters by refraction.
  void addBase(const SurfaceInteraction& at, const Appearance& a, float thinTransmission,
               Bsdf& bsdf) const {
    if (!(a.diffuse > 0)) return;
    const bool below = !reflectance(scatterDistance_(at)).isBlack();
    if (below) bsdf.add<SmoothDielectric>(Rgb(), Rgb(1), a.eta);
    const Rgb weighed = a.diffuse * a.color;
    const float flat = thin_ ? share(flatness_(at)) : 0.f;
    const float sheen = reflectance(Rgb(sheen_(at))).r;
    DisneyBase::Colors c;
    if (!below) c.diffuse = weighed * ((1 - flat) * (1 - thinTransmission));
    c.flat = weighed * (flat * (1 - thinTransmission));
    c.retro = weighed;
    if (sheen > 0) c.sheen = a.diffuse * sheen * lerp(share(sheenTint_(at)), Rgb(1), a.tint);
    if (!weighed.isBlack() || !c.sheen.isBlack()) bsdf.add<DisneyBase>(c, a.roughness);
  }
  void addReflections(const SurfaceInteraction& at, const Appearance& a, Bsdf& bsdf) const {
    addMirror(at, a, bsdf);
    const float coat = reflectance(Rgb(clearcoat_(at))).r;
    if (coat > 0) bsdf.add<DisneyClearcoat>(coat, share(clearcoatGloss_(at)));
  }
  void addMirror(const SurfaceInteraction& at, const Appearance& a, Bsdf& bsdf) const {
    if (a.eta == 1 && a.metallic == 0) return;
    const float r0 = sqr((a.eta - 1) / (a.eta + 1));
    const Rgb dielectric = r0 * lerp(share(specularTint_(at)), Rgb(1), a.tint);
    const DisneyFresnel fresnel{lerp(a.metallic, dielectric, a.color), a.metallic, a.eta};
    bsdf.add<MicrofacetReflection<DisneyFresnel, SeparableTrowbridgeReitz>>(
        Rgb(1), a.facets(a.roughness), fresnel);
  }
  /// The square root gives the colour after light has entered and left.
  void addRefraction(const Appearance& a, float transmitted, Bsdf& bsdf) const {
    const Rgb colour = transmitted * sqrt(a.color);
    if (colour.isBlack()) return;
    if (isInvisible(a.eta)) {
      bsdf.add<SmoothDielectric>(Rgb(), colour, 1.f);
    } else if (thin_) {
      // The two sides of a sheet blur by other angles than one boundary does (Burley 2015, fig.
      // 15).
      const TrowbridgeReitz facets = a.facets((0.65f * a.eta - 0.35f) * a.roughness);
      bsdf.add<RoughDielectric<>>(Rgb(), colour, facets, a.eta);
    } else {
      bsdf.add<RoughDielectric<SeparableTrowbridgeReitz>>(Rgb(), colour, a.facets(a.roughness),
                                                          a.eta);
    }
  }

  TexturedRgb color_, scatterDistance_;  ///< the second is black for thin sheets
  TexturedFloat metallic_, eta_, roughness_, specularTint_, anisotropic_, sheen_, sheenTint_;
  TexturedFloat clearcoat_, clearcoatGloss_, specTrans_, flatness_, diffTrans_;
  bool thin_;
};

}  // namespace

MaterialRegistry::Entry disneyPlugin() {
  return makePlugin("disney", "Disney's principled material.",
                    createMaterial<DisneyMaterial, DisneyParameters>);
}

}  // namespace lampyris
