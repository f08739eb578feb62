// SPDX-License-Identifier: Apache-2.0
#include "materials/lambert.h"
#include "materials/oren_nayar.h"
#include "materials/surface_material.h"

namespace lampyris {
namespace {

struct MatteParameters : SurfaceParameters {
  RgbInput kd = 0.5f;
  FloatInput sigma = 0;
  void declare(Declaration& d) {
    d.add("Kd", kd, "Diffuse reflectance.").clamped(0);
    d.add("sigma", sigma, "Roughness of Oren and Nayar's model in degrees; 0 is Lambert's.")
        .clamped(0, 90);
    declareSurface(d);
  }
};

class MatteMaterial final : public SurfaceMaterial {
 public:
  MatteMaterial(const MatteParameters& p, const MaterialContext& c)
      : SurfaceMaterial(p, c), kd_(input(c, p.kd)), sigma_(input(c, p.sigma)) {}

  void addLobes(const SurfaceInteraction& at, Bsdf& bsdf) const override {
    const Rgb kd = reflectance(kd_(at));
    if (kd.isBlack()) return;
    const float sigma = std::min(90.f, std::max(0.f, sigma_(at)));
    if (sigma == 0)
      bsdf.add<LambertReflection>(kd);
    else
      bsdf.add<OrenNayar>(kd, sigma);
  }

 private:
  TexturedRgb kd_;
  TexturedFloat sigma_;
};

}  // namespace

MaterialRegistry::Entry mattePlugin() {
  return makePlugin("matte", "Diffuse reflection.", createMaterial<MatteMaterial, MatteParameters>);
}

}  // namespace lampyris
