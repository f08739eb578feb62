// SPDX-License-Identifier: Apache-2.0
#include "textures/texture_input.h"

namespace lampyris {

namespace {

template <class T>
struct ConstantParameters {
  T value{1};

  void declare(Declaration& d) { d.add("value", value, "The value everywhere.").any(); }
};

template <class T>
class ConstantTexture final : public Texture<T> {
 public:
  explicit ConstantTexture(const T& value) : value_(value) {}
  T evaluate(const SurfaceInteraction&) const override { return value_; }

 private:
  T value_;
};

template <class T>
std::unique_ptr<Texture<T>> create(const ConstantParameters<T>& p, const TextureContext&) {
  return std::make_unique<ConstantTexture<T>>(p.value);
}

template <class T>
TexturePlugin<T> plugin() {
  return makePlugin("constant", "The same value everywhere.", create<T>);
}

}  // namespace

TexturePlugin<float> constantFloatTexturePlugin() { return plugin<float>(); }
TexturePlugin<Rgb> constantSpectrumTexturePlugin() { return plugin<Rgb>(); }

}  // namespace lampyris
