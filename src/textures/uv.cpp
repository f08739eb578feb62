// SPDX-License-Identifier: Apache-2.0
#include <cmath>

#include "textures/texture_input.h"
#include "textures/texture_mapping.h"

namespace lampyris {

namespace {

struct UvParameters {
  MappingParameters mapping;
  void declare(Declaration& d) { mapping.declare(d); }
};

class UvTexture final : public SpectrumTexture {
 public:
  explicit UvTexture(const TextureMapping2D& mapping) : mapping_(mapping) {}
  Rgb evaluate(const SurfaceInteraction& at) const override {
    const Vec2 st = mapping_.map(at).st;
    return {st.x - std::floor(st.x), st.y - std::floor(st.y), 0};
  }

 private:
  TextureMapping2D mapping_;
};

std::unique_ptr<SpectrumTexture> create(const UvParameters& p, const TextureContext& c) {
  return std::make_unique<UvTexture>(TextureMapping2D(p.mapping, c.textureToWorld));
}

}  // namespace

TexturePlugin<Rgb> uvSpectrumTexturePlugin() {
  return makePlugin("uv", "Texture coordinates as red and green.", create);
}

}  // namespace lampyris
