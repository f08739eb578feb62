// SPDX-License-Identifier: Apache-2.0
#include "base/light.h"
#include "core/huge_page_object.h"
#include "lights/cone_emission.h"
#include "lights/emission.h"
#include "lights/point_sample.h"

namespace lampyris {
namespace {

struct PointLightParameters {
  Rgb intensity{1}, scale{1};
  Vec3 from{0};
  void declare(Declaration& d) {
    declareColor(d, "I", intensity, "Radiant intensity (W/sr).", scale);
    d.add("from", from, "Position, in the light's space.").any();
  }
};

class PointLight final : public Light, public HugePageObject {
 public:
  PointLight(const Vec3& p, const Rgb& intensity) : p_(p), intensity_(intensity) {}

  bool isDelta() const override { return true; }

  std::optional<LightSample> sample(uint32_t, const Vec3& from, const Vec2&) const override {
    return samplePoint(p_, from, [this](const Vec3&) { return intensity_; });
  }

  std::optional<EmissionSample> sampleEmission(uint32_t, const Vec2&,
                                               const Vec2& v) const override {
    return ConeEmission().emit(p_, v, [this](const Vec3&) { return intensity_; });
  }
  EmissionPdf emissionPdf(uint32_t, const Vec3&, const Vec3& w) const override {
    return {1, ConeEmission().pdf(w)};
  }

  Rgb power(uint32_t) const override { return 4 * kPi * intensity_; }
  std::optional<LightBounds> bounds(uint32_t) const override {
    LightBounds b;
    b.box = Bounds3(p_);
    b.intensity = intensity_.luminance();
    return b;
  }

 private:
  Vec3 p_;
  Rgb intensity_;
};

std::unique_ptr<Light> create(const PointLightParameters& p, const LightContext& context) {
  return std::make_unique<PointLight>(context.lightToWorld.point(p.from),
                                      emittedColor(p.intensity, p.scale, context));
}

}  // namespace

LightRegistry::Entry pointLightPlugin() {
  return makePlugin("point", "Light from a point, equal in all directions.", create);
}

}  // namespace lampyris
