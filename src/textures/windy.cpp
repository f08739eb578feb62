// SPDX-License-Identifier: Apache-2.0
// Waves on water in gusts of wind: noise times the strength of noise ten times as coarse.
#include <cmath>

#include "textures/noise.h"
#include "textures/texture_input.h"

namespace lampyris {

namespace {

struct WindyParameters {
  void declare(Declaration&) {}
};

template <class T>
class WindyTexture final : public Texture<T> {
 public:
  explicit WindyTexture(const TextureMapping3D& mapping) : mapping_(mapping) {}
  T evaluate(const SurfaceInteraction& at) const override {
    constexpr Octaves kGusts{3, 0.5f}, kWaves{6, 0.5f};
    const TexturePoint p = mapping_.map(at);
    return T(std::abs(fractalNoise(p * 0.1f, kGusts)) * fractalNoise(p, kWaves));
  }

 private:
  TextureMapping3D mapping_;
};

template <class T>
std::unique_ptr<Texture<T>> create(const WindyParameters&, const TextureContext& c) {
  return std::make_unique<WindyTexture<T>>(TextureMapping3D(c.textureToWorld));
}

template <class T>
TexturePlugin<T> plugin() {
  return makePlugin("windy", "Waves in gusts of wind, for bump maps.", create<T>);
}

}  // namespace

TexturePlugin<float> windyFloatTexturePlugin() { return plugin<float>(); }
TexturePlugin<Rgb> windySpectrumTexturePlugin() { return plugin<Rgb>(); }

}  // namespace lampyris
