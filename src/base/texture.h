// SPDX-License-Identifier: Apache-2.0
/// Textures: values that vary over surfaces.
#pragma once

#include "base/interaction.h"
#include "core/parameters.h"
#include "core/registry.h"
#include "core/rgb.h"
#include "core/transform.h"

namespace lampyris {

template <class T>
class Texture {
 public:
  virtual ~Texture() = default;
  /// Uses p, uv and the differentials of the interaction only.
  virtual T evaluate(const SurfaceInteraction& at) const = 0;
};
using FloatTexture = Texture<float>;
using SpectrumTexture = Texture<Rgb>;

/// A constant or a texture; what materials keep.
template <class T>
struct Textured {
  T value{};
  const Texture<T>* texture = nullptr;

  T operator()(const SurfaceInteraction& at) const {
    return texture ? texture->evaluate(at) : value;
  }
  bool isConstant() const { return !texture; }
};
using TexturedFloat = Textured<float>;
using TexturedRgb = Textured<Rgb>;

/// Turns parameters into textures that the scene owns. Throws SceneError on an unknown name.
class TextureResolver {
 public:
  virtual ~TextureResolver() = default;
  virtual TexturedFloat resolve(const FloatInput& input) const = 0;
  virtual TexturedRgb resolve(const RgbInput& input) const = 0;
};

class ImageCache;

/// Where files of a scene are, and who hears warnings.
struct BuildContext {
  Diagnostics& diagnostics;
  /// The path of a file named in the scene (relative names: from the scene file's folder).
  std::function<std::string(const std::string&)> resolvePath;
  SourceLocation location;  ///< of the directive being built
};

struct TextureContext : BuildContext {
  const TextureResolver& textures;
  ImageCache& images;
  Transform textureToWorld;
};

using FloatTextureRegistry = Registry<FloatTexture, TextureContext>;
using SpectrumTextureRegistry = Registry<SpectrumTexture, TextureContext>;

}  // namespace lampyris
