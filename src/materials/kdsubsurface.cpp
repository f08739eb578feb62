// SPDX-License-Identifier: Apache-2.0
#include "materials/diffusion_material.h"

namespace lampyris {
namespace {

struct KdSubsurfaceParameters : DiffusionParameters {
  RgbInput kd = 0.5f, mfp = 1.f;
  void declare(Declaration& d) {
    d.add("Kd", kd, "Share of light that comes out again.").clamped(0);
    d.add("mfp", mfp, "Mean free path in the medium, in the scene's unit of length.").clamped(0);
    declareDiffusion(d, "Factor on the mean free path.");
  }
};

class KdSubsurfaceMaterial final : public DiffusionMaterial {
 public:
  KdSubsurfaceMaterial(const KdSubsurfaceParameters& p, const MaterialContext& c)
      : DiffusionMaterial(p, c), kd_(input(c, p.kd)), mfp_(input(c, p.mfp)) {}

 private:
  /// Finds the albedo of the medium that shows the colour.
  Medium medium(const SurfaceInteraction& at) const override {
    const Rgb kd = reflectance(kd_(at)), mfp = scale() * reflectance(mfp_(at));
    const Rgb albedo(table().albedoOfReflectance(kd.r), table().albedoOfReflectance(kd.g),
                     table().albedoOfReflectance(kd.b));
    // A mean free path of 0 counts as no medium at all: nothing comes out again.
    const Rgb sigmaT(safeDivide(1, mfp.r), safeDivide(1, mfp.g), safeDivide(1, mfp.b));
    return {sigmaT * (Rgb(1) - albedo), sigmaT * albedo};
  }
  TexturedRgb kd_, mfp_;
};

}  // namespace

MaterialRegistry::Entry kdSubsurfacePlugin() {
  return makePlugin("kdsubsurface", "Dielectric body in which light diffuses, by its colour.",
                    createMaterial<KdSubsurfaceMaterial, KdSubsurfaceParameters>);
}

}  // namespace lampyris
