// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <glm/matrix.hpp>

#include "base/light.h"
#include "lights/distant_disk.h"
#include "lights/emission.h"
#include "lights/environment_map.h"

namespace lampyris {
namespace {

struct InfiniteLightParameters {
  Rgb radiance{1}, scale{1};
  int samples = 1;
  std::string map;
  void declare(Declaration& d) {
    declareColor(d, "L", radiance, "Radiance from all directions, or a factor on the map.", scale);
    d.add("samples", samples, "Wish for samples a point in direct lighting.")
        .alias("nsamples")
        .range(1, 1e6);
    d.add("mapname", map, "Latitude-longitude image, z up; values are taken as linear.")
        .rangeIs("any file name, or none");
  }
};

/// What the two kinds share.
class InfiniteLight : public Light {
 public:
  explicit InfiniteLight(int samples) : samples_(samples) {}

  bool isDelta() const override { return false; }
  bool isInfinite() const override { return true; }
  void prepare(const Bounds3& scene) override { disk_.cover(scene); }
  std::optional<EmissionSample> sampleEmission(uint32_t element, const Vec2& u,
                                               const Vec2& v) const override {
    // The direction does not depend on the place.
    const auto from = sample(element, Vec3(0), v);
    if (!from) return std::nullopt;
    EmissionSample s = disk_.start(u, -from->wi);
    s.radiance = from->radiance;
    s.pdfDirection = from->pdf;
    return s;
  }
  EmissionPdf emissionPdf(uint32_t, const Vec3&, const Vec3& w) const override {
    return {disk_.pdfPosition(), pdfEscape(-w)};
  }
  std::optional<LightBounds> bounds(uint32_t) const override { return std::nullopt; }
  int samples() const override { return samples_; }

 protected:
  /// pbrt-v3's figure for mean radiance `mean`.
  Rgb powerOf(const Rgb& mean) const { return mean * (kPi * sqr(disk_.radius())); }

 private:
  int samples_;
  DistantDisk disk_;
};

class ConstantInfiniteLight final : public InfiniteLight {
 public:
  ConstantInfiniteLight(const Rgb& radiance, int samples)
      : InfiniteLight(samples), radiance_(radiance) {}

  std::optional<LightSample> sample(uint32_t, const Vec3&, const Vec2& u) const override {
    if (radiance_.isBlack()) return std::nullopt;
    LightSample s;
    s.radiance = radiance_;
    s.wi = sampleUniformSphere(u);
    s.pdf = pdfEscape(s.wi);
    return s;
  }
  float pdfEscape(const Vec3&) const override { return kInvPi / 4; }
  Rgb escaped(const Vec3&) const override { return radiance_; }
  Rgb power(uint32_t) const override { return powerOf(radiance_); }
  float irradianceEstimate(const Vec3&, bool transmits) const override {
    return radiance_.luminance() * (transmits ? 2 * kPi : kPi);
  }

 private:
  Rgb radiance_;
};

class MappedInfiniteLight final : public InfiniteLight {
 public:
  MappedInfiniteLight(std::shared_ptr<const EmissionImage> image, const Rgb& scale, int samples,
                      const Transform& lightToWorld)
      : InfiniteLight(samples),
        map_(std::move(image), scale),
        lightToWorld_(lightToWorld),
        worldToLight_(lightToWorld.inverse()),
        determinant_(
            std::abs(static_cast<float>(glm::determinant(glm::dmat3(worldToLight_.matrix()))))) {}

  std::optional<LightSample> sample(uint32_t, const Vec3&, const Vec2& u) const override {
    LightSample s;
    s.wi = normalize(lightToWorld_.vector(map_.sample(u)));
    // Looked up again rather than kept, so that it is what MIS sees for the rounded direction.
    s.pdf = pdfEscape(s.wi);
    s.radiance = escaped(s.wi);
    if (!(s.pdf > 0) || s.radiance.isBlack()) return std::nullopt;
    return s;
  }
  float pdfEscape(const Vec3& wi) const override {
    // A transform that is no rotation changes solid angles: dω' = |det A| / |A ω|³ dω.
    const Vec3 local = worldToLight_.vector(wi);
    const float scale = length(local);
    return map_.pdf(local / scale) * safeDivide(determinant_, scale * scale * scale);
  }
  Rgb escaped(const Vec3& d) const override {
    return map_.radiance(normalize(worldToLight_.vector(d)));
  }
  Rgb power(uint32_t) const override { return powerOf(map_.mean()); }
  float irradianceEstimate(const Vec3& n, bool transmits) const override {
    return map_.irradiance(normalize(worldToLight_.vector(n)), transmits);
  }

 private:
  EnvironmentMap map_;
  Transform lightToWorld_, worldToLight_;
  float determinant_;
};

std::unique_ptr<Light> create(const InfiniteLightParameters& p, const LightContext& context) {
  const Rgb scale = emittedColor(p.radiance, p.scale, context);
  if (p.map.empty()) return std::make_unique<ConstantInfiniteLight>(scale, p.samples);
  if (context.lightToWorld.isSingular())
    throw SceneError(context.location,
                     "the infinite light's transform has no inverse (a scale of 0?)");
  return std::make_unique<MappedInfiniteLight>(
      EmissionImage::load(p.map, EmissionImage::Encoding::Linear, context.images, context), scale,
      p.samples, context.lightToWorld);
}

}  // namespace

LightRegistry::Entry infiniteLightPlugin() {
  return makePlugin("infinite", "Light from all directions: constant, or an environment map.",
                    create, {"exinfinite"});
}

}  // namespace lampyris
