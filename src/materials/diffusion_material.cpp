// SPDX-License-Identifier: Apache-2.0
#include "materials/diffusion_material.h"

namespace lampyris {

void DiffusionParameters::declareDiffusion(Declaration& d, std::string scaleDoc) {
  d.add("eta", eta, "Index of refraction inside.").range(1, kMaxEta);
  d.add("g", g, "Mean cosine of a scattering event: above 0 light goes on, below it turns back.")
      .range(-0.999, 0.999);
  d.add("scale", scale, std::move(scaleDoc)).atLeast(0);
  declareBoundary(d);
  declareSurface(d);
}

DiffusionMaterial::DiffusionMaterial(const DiffusionParameters& p, const MaterialContext& context)
    : SurfaceMaterial(p, context),
      kr_(input(context, p.kr)),
      kt_(input(context, p.kt)),
      roughness_(input(context, p.uRoughness), input(context, p.vRoughness), p.remapRoughness),
      eta_(p.eta),
      scale_(p.scale),
      table_(p.g, p.eta) {}

void DiffusionMaterial::addLobes(const SurfaceInteraction& at, Bsdf& bsdf) const {
  addBoundary(reflectance(kr_(at)), reflectance(kt_(at)), roughness_(at), eta_, bsdf);
}

const Bssrdf* DiffusionMaterial::bssrdf(const SurfaceInteraction& at,
                                        BssrdfStorage& storage) const {
  const Medium m = medium(at);
  return storage.make<TabulatedBssrdf>(table_, eta_, m.sigmaA, m.sigmaS);
}

}  // namespace lampyris
