// SPDX-License-Identifier: Apache-2.0
/// Builds textures and materials, each when it is first needed: what nothing refers to is never
/// built, and its files are never opened.
#pragma once

#include <mutex>
#include <vector>

#include "base/material.h"
#include "scene/build_state.h"

namespace lampyris {

class AppearanceBuilder {
 public:
  explicit AppearanceBuilder(BuildState& state);

  /// The material of a shape (null: none), with the shape's own parameters in place of the
  /// material's where it has any, as in pbrt-v3.
  const Material* materialOf(const ShapeDescription& shape);
  /// The schema of that material; null if there is none.
  const Schema* materialSchema(const ShapeDescription& shape) const;

  /// Finds names as they are defined at a place in the file. Thread-safe.
  class Resolver final : public TextureResolver, public MaterialResolver {
   public:
    Resolver(AppearanceBuilder& builder, uint32_t order) : builder_(builder), order_(order) {}
    TexturedFloat resolve(const FloatInput& input) const override;
    TexturedRgb resolve(const RgbInput& input) const override;
    const Material* resolve(const std::string& name, SourceLocation where) const override;

   private:
    AppearanceBuilder& builder_;
    uint32_t order_;
  };

 private:
  /// Built is what the definitions with the same index have become.
  template <class T>
  struct Built {
    T* object = nullptr;
    bool done = false;
    size_t evaluations = 0;  ///< of textures, for one value of a texture
  };
  const Material* material(uint32_t index);
  const Material* create(const MaterialRegistry::Entry& plugin, const ParameterSet& set,
                         uint32_t order);
  const FloatTexture* floatTexture(const std::string& name, uint32_t order, SourceLocation where);
  const SpectrumTexture* spectrumTexture(const std::string& name, uint32_t order,
                                         SourceLocation where);
  template <class R, class T>
  T* buildTexture(const R& registry, uint32_t index, std::vector<std::unique_ptr<T>>& owner,
                  std::vector<Built<T>>& built);
  class DepthGuard;

  BuildState& state_;
  std::recursive_mutex mutex_;
  int depth_ = 0;
  size_t evaluations_ = 0;  ///< that the texture which is being built needs
  std::vector<Built<FloatTexture>> floatTextures_;
  std::vector<Built<SpectrumTexture>> spectrumTextures_;
  std::vector<Built<const Material>> materials_;
};

/// True for the materials "" and "none".
bool isNoMaterial(const MaterialDefinition& material);

}  // namespace lampyris
