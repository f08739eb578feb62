// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "base/measured_media.h"
#include "materials/diffusion_material.h"

namespace lampyris {
namespace {

/// Whole milk's, per millimetre.
constexpr Rgb kDefaultSigmaA(0.0011f, 0.0024f, 0.014f), kDefaultSigmaS(2.55f, 3.21f, 3.77f);

struct SubsurfaceParameters : DiffusionParameters {
  std::string name;
  std::optional<RgbInput> sigmaA, sigmaS;
  void declare(Declaration& d) {
    d.add("name", name, "A measured medium, e.g. \"Skin1\", per millimetre; \"g\" is 0 then.")
        .rangeIs("the name of a measured medium, or none");
    d.add("sigma_a", sigmaA, "Absorption, instead of the medium's.")
        .defaultIs("0.0011 0.0024 0.014")
        .clamped(0);
    d.add("sigma_s", sigmaS, "Scattering, instead of the medium's.")
        .defaultIs("2.55 3.21 3.77")
        .clamped(0);
    declareDiffusion(d, "Factor on absorption and scattering, e.g. for the unit of length.");
  }
};

/// The parameters with a named medium filled in.
SubsurfaceParameters resolved(SubsurfaceParameters p, const MaterialContext& c) {
  Rgb sigmaA = kDefaultSigmaA, sigmaS = kDefaultSigmaS;
  if (!p.name.empty()) {
    const MeasuredMedium* m = findMeasuredMedium(p.name);
    if (!m)
      throw SceneError(c.location, fmt::format("unknown medium \"{}\"{}", p.name,
                                               didYouMean(p.name, measuredMediumNames())));
    sigmaA = m->sigmaA;
    sigmaS = m->sigmaPrimeS;
    p.g = 0;
  }
  if (!p.sigmaA) p.sigmaA = sigmaA;
  if (!p.sigmaS) p.sigmaS = sigmaS;
  return p;
}

class SubsurfaceMaterial final : public DiffusionMaterial {
 public:
  /// `p` as of resolved().
  SubsurfaceMaterial(const SubsurfaceParameters& p, const MaterialContext& c)
      : DiffusionMaterial(p, c), sigmaA_(input(c, *p.sigmaA)), sigmaS_(input(c, *p.sigmaS)) {}

 private:
  Medium medium(const SurfaceInteraction& at) const override {
    return {scale() * reflectance(sigmaA_(at)), scale() * reflectance(sigmaS_(at))};
  }
  TexturedRgb sigmaA_, sigmaS_;
};

std::unique_ptr<Material> create(const SubsurfaceParameters& p, const MaterialContext& c) {
  return std::make_unique<SubsurfaceMaterial>(resolved(p, c), c);
}

}  // namespace

MaterialRegistry::Entry subsurfacePlugin() {
  return makePlugin("subsurface", "Dielectric body in which light diffuses, by its coefficients.",
                    create);
}

}  // namespace lampyris
