// SPDX-License-Identifier: Apache-2.0
/// A dielectric body filled with a medium in which light diffuses: "subsurface" and "kdsubsurface"
/// say in different words which.
#pragma once

#include "materials/dielectric_boundary.h"
#include "materials/separable_bssrdf.h"

namespace lampyris {

struct DiffusionParameters : SurfaceParameters, BoundaryParameters {
  float eta = 1.33f, g = 0, scale = 1;
  void declareDiffusion(Declaration& d, std::string scaleDoc);
};

class DiffusionMaterial : public SurfaceMaterial {
 public:
  void addLobes(const SurfaceInteraction& at, Bsdf& bsdf) const final;
  bool scattersBelow() const final { return true; }
  const Bssrdf* bssrdf(const SurfaceInteraction& at, BssrdfStorage& storage) const final;

 protected:
  /// Per unit of length.
  struct Medium {
    Rgb sigmaA, sigmaS;
  };
  DiffusionMaterial(const DiffusionParameters& p, const MaterialContext& context);
  virtual Medium medium(const SurfaceInteraction& at) const = 0;
  const DiffusionTable& table() const { return table_; }
  float scale() const { return scale_; }

 private:
  TexturedRgb kr_, kt_;
  RoughnessInput roughness_;
  float eta_, scale_;
  DiffusionTable table_;
};

}  // namespace lampyris
