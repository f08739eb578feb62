// SPDX-License-Identifier: Apache-2.0
#include "base/light.h"
#include "lights/distant_disk.h"
#include "lights/emission.h"

namespace lampyris {
namespace {

struct DistantLightParameters {
  Rgb radiance{1}, scale{1};
  Vec3 from{0}, to{0, 0, 1};
  void declare(Declaration& d) {
    declareColor(d, "L", radiance, "Irradiance on a plane that faces the light (W/m²).", scale);
    d.add("from", from, "With \"to\": the light shines along to − from, in the light's space.")
        .rangeIs("any; they must differ");
    d.add("to", to, "See \"from\".").rangeIs("any; they must differ");
  }
};

class DistantLight final : public Light {
 public:
  DistantLight(const Vec3& towardsLight, const Rgb& irradiance)
      : w_(towardsLight), irradiance_(irradiance) {}

  bool isDelta() const override { return true; }
  bool isInfinite() const override { return true; }
  void prepare(const Bounds3& scene) override { disk_.cover(scene); }

  std::optional<LightSample> sample(uint32_t, const Vec3&, const Vec2&) const override {
    if (irradiance_.isBlack()) return std::nullopt;
    LightSample s;
    s.radiance = irradiance_;
    s.wi = w_;
    s.pdf = 1;
    return s;
  }

  std::optional<EmissionSample> sampleEmission(uint32_t, const Vec2& u,
                                               const Vec2&) const override {
    if (irradiance_.isBlack()) return std::nullopt;
    EmissionSample s = disk_.start(u, -w_);
    s.radiance = irradiance_;
    s.pdfDirection = 1;
    return s;
  }
  EmissionPdf emissionPdf(uint32_t, const Vec3&, const Vec3&) const override {
    return {disk_.pdfPosition(), 1};
  }

  Rgb power(uint32_t) const override { return irradiance_ * (kPi * sqr(disk_.radius())); }
  std::optional<LightBounds> bounds(uint32_t) const override { return std::nullopt; }
  float irradianceEstimate(const Vec3& n, bool transmits) const override {
    const float cosine = dot(n, w_);
    return irradiance_.luminance() * (transmits ? std::abs(cosine) : std::max(cosine, 0.f));
  }

 private:
  Vec3 w_;
  Rgb irradiance_;
  DistantDisk disk_;
};

std::unique_ptr<Light> create(const DistantLightParameters& p, const LightContext& context) {
  const Vec3 w = normalize(context.lightToWorld.vector(p.from - p.to));
  if (w == Vec3(0))
    throw SceneError(context.location,
                     "\"from\" and \"to\" of the distant light must be different "
                     "points: they give its direction");
  return std::make_unique<DistantLight>(w, emittedColor(p.radiance, p.scale, context));
}

}  // namespace

LightRegistry::Entry distantLightPlugin() {
  return makePlugin("distant", "Parallel light from infinitely far away.", create);
}

}  // namespace lampyris
