// SPDX-License-Identifier: Apache-2.0
#include "core/frame.h"
#include "lights/pattern_light.h"

namespace lampyris {
namespace {

/// pbrt-v3's orientation: y is up, the image's top row lies at θ = 0 and columns run with φ from +x
/// over +z.
Vec3 swapYz(const Vec3& w) { return {w.x, w.z, w.y}; }

class GoniometricLight final : public PatternLight {
 public:
  GoniometricLight(const PatternLightParameters& p, const LightContext& context)
      : PatternLight(p, context, "goniometric") {
    if (!image()) return;
    meanPattern_ = image()->weightedMean([this](double s, double t) {
      const auto theta = static_cast<float>(t) * kPi, phi = static_cast<float>(s) * 2 * kPi;
      const float sine = std::sin(theta);
      const Vec3 w = swapYz(sphericalDirection(sine, std::cos(theta), phi));
      return static_cast<double>(sine) * stretch(w);
    });
  }

  /// pbrt-v3's figure, by the mean of the texels.
  Rgb power(uint32_t) const override {
    return 4 * kPi * intensity() * (image() ? image()->mean() : Rgb(1));
  }
  std::optional<LightBounds> bounds(uint32_t) const override { return boundsOf(meanPattern_); }

 private:
  Rgb pattern(const Vec3& w) const override {
    if (!image()) return Rgb(1);
    const Vec3 up = swapYz(w);
    return image()->bilinear({sphericalPhi(up) / (2 * kPi), sphericalTheta(up) * kInvPi});
  }

  Rgb meanPattern_{1};  ///< over the sphere
};

std::unique_ptr<Light> create(const PatternLightParameters& p, const LightContext& context) {
  return std::make_unique<GoniometricLight>(p, context);
}

}  // namespace

LightRegistry::Entry goniometricLightPlugin() {
  return makePlugin("goniometric",
                    "Light from a point whose intensity is an image over all directions, y up.",
                    create);
}

}  // namespace lampyris
