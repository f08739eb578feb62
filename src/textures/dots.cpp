// SPDX-License-Identifier: Apache-2.0
// Polka dots: noise decides which unit cells have a dot, and where in the cell it lies. As in
// pbrt-v3 the parameter "inside" is what lies between the dots, "outside" what fills them.
#include <cmath>

#include "textures/noise.h"
#include "textures/texture_input.h"

namespace lampyris {

namespace {

template <class T>
struct DotsParameters {
  TextureInput<T> inside{1.f}, outside{0.f};
  MappingParameters mapping;

  void declare(Declaration& d) {
    d.add("inside", inside, "Between the dots (as in pbrt-v3).").any();
    d.add("outside", outside, "In the dots (as in pbrt-v3).").any();
    mapping.declare(d);
  }
};

/// Whether a point lies in a dot. The offsets of the noise are pbrt-v3's.
bool isInDot(const Vec2& st) {
  constexpr float kRadius = 0.35f, kMostShift = 0.5f - kRadius;
  const Vec2 cell = glm::floor(st + 0.5f);
  const auto noise = [&cell](float s, float t) {
    return perlinNoise({cell.x + s, cell.y + t, 0.5f});
  };
  if (!(noise(0.5f, 0.5f) > 0)) return false;
  const Vec2 centre = cell + kMostShift * Vec2(noise(1.5f, 2.8f), noise(4.5f, 9.8f));
  return dot(st - centre, st - centre) < kRadius * kRadius;
}

template <class T>
class DotsTexture final : public Texture<T> {
 public:
  DotsTexture(const Textured<T>& inside, const Textured<T>& outside,
              const TextureMapping2D& mapping)
      : inside_(inside), outside_(outside), mapping_(mapping) {}
  T evaluate(const SurfaceInteraction& at) const override {
    return isInDot(mapping_.map(at).st) ? outside_(at) : inside_(at);
  }

 private:
  Textured<T> inside_, outside_;
  TextureMapping2D mapping_;
};

template <class T>
std::unique_ptr<Texture<T>> create(const DotsParameters<T>& p, const TextureContext& c) {
  return std::make_unique<DotsTexture<T>>(c.textures.resolve(p.inside),
                                          c.textures.resolve(p.outside),
                                          TextureMapping2D(p.mapping, c.textureToWorld));
}

template <class T>
TexturePlugin<T> plugin() {
  return makePlugin("dots", "Dots scattered over a grid of unit cells.", create<T>);
}

}  // namespace

TexturePlugin<float> dotsFloatTexturePlugin() { return plugin<float>(); }
TexturePlugin<Rgb> dotsSpectrumTexturePlugin() { return plugin<Rgb>(); }

}  // namespace lampyris
