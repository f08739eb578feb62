// SPDX-License-Identifier: Apache-2.0
#include "materials/hair_lobe.h"
#include "materials/surface_material.h"

namespace lampyris {
namespace {

/// Below, lobes are narrower than floats can tell directions apart.
constexpr float kMinBeta = 0.01f;

struct HairParameters {
  std::optional<RgbInput> sigmaA, color;
  std::optional<FloatInput> eumelanin, pheomelanin;
  FloatInput eta = 1.55f, betaM = 0.3f, betaN = 0.3f, alpha = 2;
  void declare(Declaration& d) {
    d.add("sigma_a", sigmaA, "Absorption over the hair's radius; before all other colours.")
        .defaultIs("of eumelanin 1.3")
        .clamped(0);
    d.add("color", color, "Colour of many hairs, in place of an absorption.").clamped(0);
    d.add("eumelanin", eumelanin, "Concentration of brown pigment, if neither of these is given.")
        .clamped(0);
    d.add("pheomelanin", pheomelanin, "Concentration of red pigment, if neither is given.")
        .clamped(0);
    d.add("eta", eta, "Index of refraction inside.").range(1, kMaxEta);
    d.add("beta_m", betaM, "Roughness along the hair, in [0, 1].").range(0, 1);
    d.add("beta_n", betaN, "Roughness around the hair, in [0, 1].").range(0, 1);
    d.add("alpha", alpha, "Tilt of the scales on its surface, in degrees.").range(-90, 90);
    d.ignored("bumpmap", "hair has no bump map, as in pbrt-v3");
  }
};

/// The colour is given by one of several sets of parameters.
class HairMaterial final : public SurfaceMaterial {
 public:
  HairMaterial(const HairParameters& p, const MaterialContext& c)
      : eta_(input(c, p.eta)),
        betaM_(input(c, p.betaM)),
        betaN_(input(c, p.betaN)),
        alpha_(input(c, p.alpha)) {
    const bool melanin = p.eumelanin || p.pheomelanin;
    if (int{p.sigmaA.has_value()} + p.color.has_value() + melanin > 1)
      c.diagnostics.warn(c.location,
                         "material \"hair\" has several colours: \"sigma_a\" counts before "
                         "\"color\", and that before \"eumelanin\" and \"pheomelanin\"");
    if (p.sigmaA) {
      source_ = Source::Absorption;
      color_ = input(c, *p.sigmaA);
    } else if (p.color) {
      source_ = Source::Color;
      color_ = input(c, *p.color);
    } else {
      constexpr float kBrown = 1.3f;
      eumelanin_ = input(c, p.eumelanin, {melanin ? 0 : kBrown});
      pheomelanin_ = input(c, p.pheomelanin, {0});
    }
  }

  void addLobes(const SurfaceInteraction& at, Bsdf& bsdf) const override {
    HairLobe::Parameters p;
    // The curve's v goes across its width.
    p.h = std::clamp(2 * at.uv.y - 1, -1.f, 1.f);
    p.eta = std::max(1.f, refractiveIndex(eta_(at)));
    p.betaM = roughness(betaM_(at));
    p.betaN = roughness(betaN_(at));
    const float alpha = alpha_(at);
    p.alpha = std::isfinite(alpha) ? alpha : 0.f;
    p.sigmaA = absorption(at, p.betaN);
    bsdf.add<HairLobe>(p);
  }

 private:
  enum class Source : uint8_t { Absorption, Color, Melanin };
  static float roughness(float beta) { return std::min(1.f, std::max(kMinBeta, beta)); }
  Rgb absorption(const SurfaceInteraction& at, float betaN) const {
    switch (source_) {
      case Source::Absorption:
        return reflectance(color_(at));
      case Source::Color:
        return hairAbsorptionOfColor(reflectance(color_(at)), betaN);
      default:
        return reflectance(hairAbsorptionOfMelanin(std::max(0.f, eumelanin_(at)),
                                                   std::max(0.f, pheomelanin_(at))));
    }
  }
  Source source_ = Source::Melanin;
  TexturedRgb color_;
  TexturedFloat eumelanin_, pheomelanin_, eta_, betaM_, betaN_, alpha_;
};

}  // namespace

MaterialRegistry::Entry hairPlugin() {
  return makePlugin("hair", "Hair and fur, for curves.",
                    createMaterial<HairMaterial, HairParameters>);
}

}  // namespace lampyris
