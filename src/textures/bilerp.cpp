// SPDX-License-Identifier: Apache-2.0
#include "textures/texture_input.h"
#include "textures/texture_mapping.h"

namespace lampyris {

namespace {

template <class T>
struct BilerpParameters {
  T v00{0}, v01{1}, v10{0}, v11{1};
  MappingParameters mapping;

  void declare(Declaration& d) {
    d.add("v00", v00, "Value at (0, 0).").any();
    d.add("v01", v01, "Value at (0, 1).").any();
    d.add("v10", v10, "Value at (1, 0).").any();
    d.add("v11", v11, "Value at (1, 1).").any();
    mapping.declare(d);
  }
};

template <class T>
class BilerpTexture final : public Texture<T> {
 public:
  BilerpTexture(const BilerpParameters<T>& p, const TextureMapping2D& mapping)
      : v00_(p.v00), v01_(p.v01), v10_(p.v10), v11_(p.v11), mapping_(mapping) {}
  T evaluate(const SurfaceInteraction& at) const override {
    const Vec2 st = mapping_.map(at).st;
    return (1 - st.x) * ((1 - st.y) * v00_ + st.y * v01_) +
           st.x * ((1 - st.y) * v10_ + st.y * v11_);
  }

 private:
  T v00_, v01_, v10_, v11_;
  TextureMapping2D mapping_;
};

template <class T>
std::unique_ptr<Texture<T>> create(const BilerpParameters<T>& p, const TextureContext& c) {
  return std::make_unique<BilerpTexture<T>>(p, TextureMapping2D(p.mapping, c.textureToWorld));
}

template <class T>
TexturePlugin<T> plugin() {
  return makePlugin("bilerp", "Bilinear interpolation of four values, one at each corner.",
                    create<T>);
}

}  // namespace

TexturePlugin<float> bilerpFloatTexturePlugin() { return plugin<float>(); }
TexturePlugin<Rgb> bilerpSpectrumTexturePlugin() { return plugin<Rgb>(); }

}  // namespace lampyris
