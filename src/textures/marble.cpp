// SPDX-License-Identifier: Apache-2.0
// Veins of marble (Perlin 1985, "An Image Synthesizer"): a wave along y that noise bends, mapped to
// colours by a spline.
#include <cmath>

#include "textures/noise.h"
#include "textures/octave_parameters.h"
#include "textures/texture_input.h"

namespace lampyris {

namespace {

struct MarbleParameters : OctaveParameters {
  float scale = 1, variation = 0.2f;

  void declare(Declaration& d) {
    OctaveParameters::declare(d);
    d.add("scale", scale, "Factor on positions.").any();
    d.add("variation", variation, "How far noise bends the veins.").any();
  }
};

/// pbrt-v3's colours: control points of which each four in a row are those of a Bézier curve.
constexpr Rgb kPale{0.58f, 0.58f, 0.6f};
constexpr Rgb kColours[] = {kPale,
                            kPale,
                            kPale,
                            {0.5f, 0.5f, 0.5f},
                            {0.6f, 0.59f, 0.58f},
                            kPale,
                            kPale,
                            {0.2f, 0.2f, 0.33f},
                            kPale};

/// The colour at t in [0, 1].
Rgb veinColour(float t) {
  constexpr int kSegments = 6;
  constexpr float kBrightness = 1.5f;
  const float along = t * kSegments;
  // As in pbrt-v3 there are two segments, the second of which goes on far beyond its end.
  const int first = std::min(1, static_cast<int>(along));
  const float s = along - static_cast<float>(first);
  const Rgb* const c = kColours + first;
  const float r = 1 - s;
  return kBrightness *
         (r * r * r * c[0] + 3 * r * r * s * c[1] + 3 * r * s * s * c[2] + s * s * s * c[3]);
}

class MarbleTexture final : public SpectrumTexture {
 public:
  MarbleTexture(const MarbleParameters& p, const TextureMapping3D& mapping)
      : p_(p), mapping_(mapping) {}
  Rgb evaluate(const SurfaceInteraction& at) const override {
    const TexturePoint p = mapping_.map(at) * p_.scale;
    const float wave = std::sin(p.p.y + p_.variation * fractalNoise(p, p_.octaves));
    return std::isfinite(wave) ? veinColour(0.5f + 0.5f * wave) : kPale;
  }

 private:
  MarbleParameters p_;
  TextureMapping3D mapping_;
};

std::unique_ptr<SpectrumTexture> create(const MarbleParameters& p, const TextureContext& c) {
  return std::make_unique<MarbleTexture>(p, TextureMapping3D(c.textureToWorld));
}

}  // namespace

TexturePlugin<Rgb> marbleSpectrumTexturePlugin() {
  return makePlugin("marble", "Veins of marble.", create);
}

}  // namespace lampyris
