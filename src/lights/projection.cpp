// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cmath>

#include "lights/pattern_light.h"

namespace lampyris {
namespace {

struct ProjectionLightParameters : PatternLightParameters {
  float fov = 45;
  void declare(Declaration& d) {
    PatternLightParameters::declare(d);
    d.add("fov", fov, "Angle that the image's shorter side takes up, in degrees.")
        .range(1e-3, 179.999);
  }
};

/// pbrt-v3's: along +z, columns run with x and rows, from the top one, with y.
class ProjectionLight final : public PatternLight {
 public:
  ProjectionLight(const ProjectionLightParameters& p, const LightContext& context)
      : PatternLight(p, context, "projection") {
    const float tangent = std::tan(radians(p.fov) / 2);
    const float aspect =
        image() ? static_cast<float>(image()->width()) / static_cast<float>(image()->height()) : 1;
    half_ = tangent * (aspect > 1 ? Vec2(aspect, 1) : Vec2(1, 1 / aspect));
    if (image())
      meanPattern_ = image()->weightedMean([this](double s, double t) {
        const Vec3 w((2 * static_cast<float>(s) - 1) * half_.x,
                     (2 * static_cast<float>(t) - 1) * half_.y, 1);
        const auto squared = static_cast<double>(lengthSquared(w));
        return stretch(w) / (squared * std::sqrt(squared));  // dω = cos³ dA
      });
    findCone();
  }

  /// pbrt-v3's figure: the mean of the texels over the cone that holds the image.
  Rgb power(uint32_t) const override {
    // 1 − cos of the corner's angle, without the cancellation that would put out narrow ones.
    const float tangent2 = dot(half_, half_), secant = std::sqrt(1 + tangent2);
    const float measure = tangent2 / (secant * (1 + secant));
    return intensity() * (image() ? image()->mean() : Rgb(1)) * (2 * kPi * measure);
  }
  std::optional<LightBounds> bounds(uint32_t) const override {
    LightBounds b = boundsOf(meanPattern_);
    if (!hasCone_) return b;
    b.axis = axis_;
    b.cosThetaO = cosTheta_;
    b.cosThetaE = 1;
    return b;
  }

 private:
  Rgb pattern(const Vec3& w) const override {
    // pbrt-v3's near plane, for a direction of unit length (there its length counts, too, so that
    // a light in an enlarged space goes out).
    constexpr float kNear = 1e-3f;
    if (w.z < kNear) return Rgb();
    const Vec2 at = Vec2(w.x, w.y) / (w.z * half_);
    if (!(std::abs(at.x) <= 1 && std::abs(at.y) <= 1)) return Rgb();
    return image() ? image()->bilinear(0.5f * at + 0.5f) : Rgb(1);
  }

  /// A cone narrower than a half space is convex: it holds the pyramid if it holds its edges. In
  /// world space, so that stretched ones are held, too.
  void findCone() {
    const std::array<Vec3, 4> edges = {
        normalize(toWorld({half_.x, half_.y, 1})), normalize(toWorld({-half_.x, half_.y, 1})),
        normalize(toWorld({half_.x, -half_.y, 1})), normalize(toWorld({-half_.x, -half_.y, 1}))};
    Vec3 sum(0);
    for (const Vec3& e : edges) sum += e;
    axis_ = normalize(sum);
    cosTheta_ = 1;
    for (const Vec3& e : edges) cosTheta_ = std::min(cosTheta_, dot(axis_, e));
    cosTheta_ -= 1e-6f;  // rounding
    hasCone_ = cosTheta_ > 0;
    float chord2 = 0;  // of the widest edge: 1 − cos without cancellation
    for (const Vec3& e : edges) chord2 = std::max(chord2, lengthSquared(e - axis_));
    if (hasCone_) emitWithin(ConeEmission(axis_, 0.5f * chord2));
  }

  Vec2 half_;           ///< half the image's sides at z = 1
  Rgb meanPattern_{1};  ///< over the pyramid
  Vec3 axis_{0};
  float cosTheta_ = -1;
  bool hasCone_ = false;
};

std::unique_ptr<Light> create(const ProjectionLightParameters& p, const LightContext& context) {
  return std::make_unique<ProjectionLight>(p, context);
}

}  // namespace

LightRegistry::Entry projectionLightPlugin() {
  return makePlugin("projection",
                    "Light from a point that throws an image, like a slide projector.", create);
}

}  // namespace lampyris
