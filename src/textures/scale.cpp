// SPDX-License-Identifier: Apache-2.0
#include "textures/texture_input.h"

namespace lampyris {

namespace {

template <class T>
struct ScaleParameters {
  TextureInput<T> tex1{1.f}, tex2{1.f};

  void declare(Declaration& d) {
    d.add("tex1", tex1, "First factor.").any();
    d.add("tex2", tex2, "Second factor.").any();
  }
};

template <class T>
class ScaleTexture final : public Texture<T> {
 public:
  ScaleTexture(const Textured<T>& a, const Textured<T>& b) : a_(a), b_(b) {}
  T evaluate(const SurfaceInteraction& at) const override { return a_(at) * b_(at); }

 private:
  Textured<T> a_, b_;
};

template <class T>
std::unique_ptr<Texture<T>> create(const ScaleParameters<T>& p, const TextureContext& c) {
  return std::make_unique<ScaleTexture<T>>(c.textures.resolve(p.tex1), c.textures.resolve(p.tex2));
}

template <class T>
TexturePlugin<T> plugin() {
  return makePlugin("scale", "The product of two textures.", create<T>);
}

}  // namespace

TexturePlugin<float> scaleFloatTexturePlugin() { return plugin<float>(); }
TexturePlugin<Rgb> scaleSpectrumTexturePlugin() { return plugin<Rgb>(); }

}  // namespace lampyris
