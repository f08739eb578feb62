// SPDX-License-Identifier: Apache-2.0
#include "base/light.h"
#include "core/huge_page_object.h"
#include "lights/cone_emission.h"
#include "lights/emission.h"
#include "lights/point_sample.h"

namespace lampyris {
namespace {

struct SpotLightParameters {
  Rgb intensity{1}, scale{1};
  Vec3 from{0}, to{0, 0, 1};
  float coneAngle = 30, coneDelta = 5;
  void declare(Declaration& d) {
    declareColor(d, "I", intensity, "Radiant intensity along the axis (W/sr).", scale);
    d.add("from", from, "Position, in the light's space.").rangeIs("any; they must differ");
    d.add("to", to, "A point that the light is directed at.").rangeIs("any; they must differ");
    d.add("coneangle", coneAngle, "Angle between the axis and the edge of the cone, in degrees.")
        .range(0, 180);
    d.add("conedeltaangle", coneDelta,
          "Width of the zone inside of the edge where the intensity falls to 0, in degrees.")
        .any();
  }
};

class SpotLight final : public Light, public HugePageObject {
 public:
  SpotLight(const SpotLightParameters& p, const Rgb& intensity, const Transform& lightToWorld)
      : p_(lightToWorld.point(p.from)),
        axis_(normalize(p.to - p.from)),
        worldToLight_(lightToWorld.inverse()),
        intensity_(intensity),
        cosTotal_(std::cos(radians(p.coneAngle))),
        cosStart_(std::cos(radians(p.coneAngle - p.coneDelta))) {
    // Normals to the start of the falloff, emission on to the edge (Ma 2018, fig. 3.3).
    const float total = radians(p.coneAngle);
    const float start = std::min(std::abs(radians(p.coneAngle - p.coneDelta)), total);
    if (!keepsAngles(lightToWorld)) return;  // the cone is none in world space
    cone_.axis = normalize(lightToWorld.vector(axis_));
    cone_.cosThetaO = std::cos(start);
    cone_.cosThetaE = std::cos(total - start);
    // 1 − cos without cancellation.
    if (total > 0) emission_ = ConeEmission(cone_.axis, 2 * sqr(std::sin(total / 2)));
  }

  bool isDelta() const override { return true; }

  std::optional<LightSample> sample(uint32_t, const Vec3& from, const Vec2&) const override {
    return samplePoint(p_, from, [this](const Vec3& w) { return intensity_ * falloff(w); });
  }

  std::optional<EmissionSample> sampleEmission(uint32_t, const Vec2&,
                                               const Vec2& v) const override {
    return emission_.emit(p_, v, [this](const Vec3& w) { return intensity_ * falloff(w); });
  }
  EmissionPdf emissionPdf(uint32_t, const Vec3&, const Vec3& w) const override {
    return {1, emission_.pdf(w)};
  }

  Rgb power(uint32_t) const override {
    return intensity_ * (2 * kPi * (1 - 0.5f * (cosStart_ + cosTotal_)));
  }
  std::optional<LightBounds> bounds(uint32_t) const override {
    LightBounds b = cone_;
    b.box = Bounds3(p_);
    // A cone of no width, all edge, sends nothing anywhere.
    b.intensity = power(0).isBlack() ? 0 : intensity_.luminance();
    return b;
  }

 private:
  /// Share of the intensity towards `w` (pbrt-v3's: measured in the light's space).
  float falloff(const Vec3& w) const {
    const float cosine = dot(axis_, normalize(worldToLight_.vector(w)));
    if (cosine < cosTotal_) return 0;
    if (cosine >= cosStart_) return 1;
    return sqr(sqr((cosine - cosTotal_) / (cosStart_ - cosTotal_)));
  }

  Vec3 p_, axis_;
  Transform worldToLight_;
  Rgb intensity_;
  float cosTotal_, cosStart_;
  LightBounds cone_;
  ConeEmission emission_;
};

std::unique_ptr<Light> create(const SpotLightParameters& p, const LightContext& context) {
  if (normalize(p.to - p.from) == Vec3(0))
    throw SceneError(context.location,
                     "\"from\" and \"to\" of the spotlight must be different "
                     "points: they give its direction");
  if (context.lightToWorld.isSingular())
    throw SceneError(context.location, "the spotlight's transform has no inverse (a scale of 0?)");
  return std::make_unique<SpotLight>(p, emittedColor(p.intensity, p.scale, context),
                                     context.lightToWorld);
}

}  // namespace

LightRegistry::Entry spotLightPlugin() {
  return makePlugin("spot", "Light from a point into a cone, with a smooth edge.", create);
}

}  // namespace lampyris
