// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/bsdf.h"
#include "base/bssrdf.h"
#include "base/texture.h"

namespace lampyris {

class Material {
 public:
  virtual ~Material() = default;
  /// Bends the shading frame of `at` (bump maps) and sets `bsdf` to this material's lobes there.
  virtual void evaluate(SurfaceInteraction& at, Bsdf& bsdf) const = 0;
  /// What evaluate() reads of the interaction.
  virtual SurfaceDetail detail() const { return SurfaceDetail::Basic; }
  /// True if any parameter is a texture that filters over the pixel footprint, so that ray
  /// differentials are worth computing.
  virtual bool wantsDifferentials() const { return false; }
  /// True if bssrdf() may answer.
  virtual bool scattersBelow() const { return false; }
  /// What becomes of light that the BSDF transmits at `at` (as evaluate() left it): made in
  /// `storage`. Null: it goes on behind the surface.
  virtual const Bssrdf* bssrdf(const SurfaceInteraction& at, BssrdfStorage& storage) const {
    return (void)at, (void)storage, nullptr;
  }
};

/// Finds named materials, for mixtures. Throws SceneError on an unknown name.
class MaterialResolver {
 public:
  virtual ~MaterialResolver() = default;
  virtual const Material* resolve(const std::string& name, SourceLocation where) const = 0;
};

struct MaterialContext : BuildContext {
  const TextureResolver& textures;
  const MaterialResolver& materials;
};

/// The material "" or "none" has no plugin: a surface without one is an interface only.
using MaterialRegistry = Registry<Material, MaterialContext>;

}  // namespace lampyris
