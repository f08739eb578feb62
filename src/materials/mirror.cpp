// SPDX-License-Identifier: Apache-2.0
#include "materials/specular_reflection.h"
#include "materials/surface_material.h"

namespace lampyris {
namespace {

struct MirrorParameters : SurfaceParameters {
  RgbInput kr = 0.9f;
  void declare(Declaration& d) {
    d.add("Kr", kr, "Reflectance.").clamped(0);
    declareSurface(d);
  }
};

class MirrorMaterial final : public SurfaceMaterial {
 public:
  MirrorMaterial(const MirrorParameters& p, const MaterialContext& c)
      : SurfaceMaterial(p, c), kr_(input(c, p.kr)) {}

  void addLobes(const SurfaceInteraction& at, Bsdf& bsdf) const override {
    const Rgb kr = reflectance(kr_(at));
    if (!kr.isBlack()) bsdf.add<SpecularReflection>(kr);
  }

 private:
  TexturedRgb kr_;
};

}  // namespace

MaterialRegistry::Entry mirrorPlugin() {
  return makePlugin("mirror", "Ideal mirror.", createMaterial<MirrorMaterial, MirrorParameters>);
}

}  // namespace lampyris
