// SPDX-License-Identifier: Apache-2.0
// The textures fbm and wrinkled: sums of noise over space, and of its absolute value.
#include "textures/noise.h"
#include "textures/octave_parameters.h"
#include "textures/texture_input.h"

namespace lampyris {

namespace {

/// Either sum has this type.
using Sum = float (*)(const TexturePoint&, const Octaves&);

template <class T, Sum kSum>
class FractalTexture final : public Texture<T> {
 public:
  FractalTexture(const Octaves& octaves, const TextureMapping3D& mapping)
      : octaves_(octaves), mapping_(mapping) {}
  T evaluate(const SurfaceInteraction& at) const override {
    return T(kSum(mapping_.map(at), octaves_));
  }

 private:
  Octaves octaves_;
  TextureMapping3D mapping_;
};

template <class T, Sum kSum>
std::unique_ptr<Texture<T>> create(const OctaveParameters& p, const TextureContext& c) {
  return std::make_unique<FractalTexture<T, kSum>>(p.octaves, TextureMapping3D(c.textureToWorld));
}

template <class T>
TexturePlugin<T> fbm() {
  return makePlugin("fbm", "Fractional Brownian motion: noise of many frequencies.",
                    create<T, fractalNoise>);
}
template <class T>
TexturePlugin<T> wrinkled() {
  return makePlugin("wrinkled", "Turbulence: the absolute value of noise of many frequencies.",
                    create<T, turbulence>);
}

}  // namespace

TexturePlugin<float> fbmFloatTexturePlugin() { return fbm<float>(); }
TexturePlugin<Rgb> fbmSpectrumTexturePlugin() { return fbm<Rgb>(); }
TexturePlugin<float> wrinkledFloatTexturePlugin() { return wrinkled<float>(); }
TexturePlugin<Rgb> wrinkledSpectrumTexturePlugin() { return wrinkled<Rgb>(); }

}  // namespace lampyris
