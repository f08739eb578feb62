// SPDX-License-Identifier: Apache-2.0
#include "textures/texture_input.h"

namespace lampyris {

namespace {

template <class T>
struct MixParameters {
  TextureInput<T> tex1{0.f}, tex2{1.f};
  FloatInput amount{0.5f};

  void declare(Declaration& d) {
    d.add("tex1", tex1, "The value where amount is 0.").any();
    d.add("tex2", tex2, "The value where amount is 1.").any();
    d.add("amount", amount, "Share of tex2.").any();
  }
};

template <class T>
class MixTexture final : public Texture<T> {
 public:
  MixTexture(const Textured<T>& a, const Textured<T>& b, const TexturedFloat& amount)
      : a_(a), b_(b), amount_(amount) {}
  T evaluate(const SurfaceInteraction& at) const override {
    const float amount = amount_(at);
    return (1 - amount) * a_(at) + amount * b_(at);
  }

 private:
  Textured<T> a_, b_;
  TexturedFloat amount_;
};

template <class T>
std::unique_ptr<Texture<T>> create(const MixParameters<T>& p, const TextureContext& c) {
  return std::make_unique<MixTexture<T>>(c.textures.resolve(p.tex1), c.textures.resolve(p.tex2),
                                         c.textures.resolve(p.amount));
}

template <class T>
TexturePlugin<T> plugin() {
  return makePlugin("mix", "Linear interpolation of two textures.", create<T>);
}

}  // namespace

TexturePlugin<float> mixFloatTexturePlugin() { return plugin<float>(); }
TexturePlugin<Rgb> mixSpectrumTexturePlugin() { return plugin<Rgb>(); }

}  // namespace lampyris
