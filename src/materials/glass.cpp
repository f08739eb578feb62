// SPDX-License-Identifier: Apache-2.0
#include "materials/dielectric_boundary.h"

namespace lampyris {
namespace {

struct GlassParameters : SurfaceParameters, BoundaryParameters {
  FloatInput eta = 1.5f;
  void declare(Declaration& d) {
    d.add("eta", eta, "Index of refraction inside.").alias("index").range(kMinEta, kMaxEta);
    declareBoundary(d);
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
    addBoundary(reflectance(kr_(at)), reflectance(kt_(at)), roughness_(at),
                refractiveIndex(eta_(at)), bsdf);
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
