// SPDX-License-Identifier: Apache-2.0
// Checkerboards over two or three coordinates. In two, "closedform" integrates the pattern over a
// box of twice the pixel's footprint, as pbrt-v3 does (Apodaca and Gritz 2000, "Advanced
// RenderMan", chapter 11: analytic box-filtered checks).
#include <algorithm>
#include <cmath>

#include "textures/texture_input.h"
#include "textures/texture_mapping.h"

namespace lampyris {

namespace {

template <class T>
struct CheckerboardParameters {
  int dimension = 2;
  TextureInput<T> tex1{1.f}, tex2{0.f};
  std::string aamode = "closedform";
  MappingParameters mapping;

  void declare(Declaration& d) {
    d.add("dimension", dimension, "2: squares over texture coordinates, 3: cubes over space.")
        .range(2, 3);
    d.add("tex1", tex1, "In the squares whose coordinates have an even sum.").any();
    d.add("tex2", tex2, "In the other squares.").any();
    d.add("aamode", aamode, "Antialiasing of a two-dimensional board.")
        .oneOf({"closedform", "none"});
    mapping.declare(d);
  }
};

/// True in cells of odd number. In floats, so that coordinates beyond the integers are no fault.
bool isOdd(float x) {
  const float cell = std::floor(x);
  return cell - 2 * std::floor(cell / 2) != 0;
}

/// ∫ from 0 to x of the indicator of odd cells.
float oddIntegral(float x) {
  const float period = std::floor(x / 2);
  return period + 2 * std::max(x / 2 - period - 0.5f, 0.f);
}

/// The share of odd cells in [x − r, x + r].
float oddShare(float x, float r) {
  if (!(r > 0)) return isOdd(x) ? 1.f : 0.f;
  return std::clamp((oddIntegral(x + r) - oddIntegral(x - r)) / (2 * r), 0.f, 1.f);
}

template <class T>
class Checkerboard2D final : public Texture<T> {
 public:
  Checkerboard2D(const Textured<T>& even, const Textured<T>& odd, const TextureMapping2D& mapping,
                 bool filtered)
      : even_(even), odd_(odd), mapping_(mapping), filtered_(filtered) {}

  T evaluate(const SurfaceInteraction& at) const override {
    const TextureCoordinates c = mapping_.map(at);
    const float share = filtered_ ? filteredShare(c) : pointShare(c.st);
    if (share <= 0) return even_(at);
    if (share >= 1) return odd_(at);
    return (1 - share) * even_(at) + share * odd_(at);
  }

 private:
  static float pointShare(const Vec2& st) { return isOdd(st.x) != isOdd(st.y) ? 1.f : 0.f; }

  /// How much of the footprint lies in odd squares.
  static float filteredShare(const TextureCoordinates& c) {
    const float rs = std::max(std::abs(c.dstdx.x), std::abs(c.dstdy.x));
    const float rt = std::max(std::abs(c.dstdx.y), std::abs(c.dstdy.y));
    const auto sameCell = [](float x, float r) { return std::floor(x - r) == std::floor(x + r); };
    if (sameCell(c.st.x, rs) && sameCell(c.st.y, rt)) return pointShare(c.st);
    if (rs > 1 || rt > 1) return 0.5f;
    const float s = oddShare(c.st.x, rs), t = oddShare(c.st.y, rt);
    return s + t - 2 * s * t;
  }

  Textured<T> even_, odd_;
  TextureMapping2D mapping_;
  bool filtered_;
};

template <class T>
class Checkerboard3D final : public Texture<T> {
 public:
  Checkerboard3D(const Textured<T>& even, const Textured<T>& odd, const TextureMapping3D& mapping)
      : even_(even), odd_(odd), mapping_(mapping) {}
  T evaluate(const SurfaceInteraction& at) const override {
    const Vec3 p = mapping_.map(at).p;
    return (isOdd(p.x) != isOdd(p.y)) != isOdd(p.z) ? odd_(at) : even_(at);
  }

 private:
  Textured<T> even_, odd_;
  TextureMapping3D mapping_;
};

template <class T>
std::unique_ptr<Texture<T>> create(const CheckerboardParameters<T>& p, const TextureContext& c) {
  const Textured<T> even = c.textures.resolve(p.tex1), odd = c.textures.resolve(p.tex2);
  if (p.dimension == 3)
    return std::make_unique<Checkerboard3D<T>>(even, odd, TextureMapping3D(c.textureToWorld));
  return std::make_unique<Checkerboard2D<T>>(
      even, odd, TextureMapping2D(p.mapping, c.textureToWorld), p.aamode == "closedform");
}

template <class T>
TexturePlugin<T> plugin() {
  return makePlugin("checkerboard", "Two textures in alternating squares or cubes.", create<T>);
}

}  // namespace

TexturePlugin<float> checkerboardFloatTexturePlugin() { return plugin<float>(); }
TexturePlugin<Rgb> checkerboardSpectrumTexturePlugin() { return plugin<Rgb>(); }

}  // namespace lampyris
