// SPDX-License-Identifier: Apache-2.0
#include "base/light.h"
#include "lights/emission.h"

namespace lampyris {
namespace {

struct DiffuseLightParameters {
  Rgb radiance{1}, scale{1};
  bool twoSided = false;
  int samples = 1;
  void declare(Declaration& d) {
    d.add("L", radiance, "Emitted radiance, W/(m² sr).");
    d.add("scale", scale, "Factor on L.");
    d.add("twosided", twoSided, "Whether the side against the normal emits as well.");
    d.add("samples", samples, "Wish for samples a point in direct lighting.")
        .alias("nsamples")
        .range(1, 1e6);
  }
};

/// All elements of a shape; nothing is kept for one of them.
class DiffuseAreaLight final : public Light {
 public:
  DiffuseAreaLight(const Shape& shape, const Rgb& radiance, bool twoSided, int samples)
      : shape_(shape), radiance_(radiance), twoSided_(twoSided), samples_(samples) {}

  uint32_t elementCount() const override { return shape_.elementCount(); }
  bool isDelta() const override { return false; }

  std::optional<LightSample> sample(uint32_t element, const Vec3& from,
                                    const Vec2& u) const override {
    const auto point = shape_.sampleSolidAngle(element, from, u);
    if (!point || !(point->pdf > 0) || !std::isfinite(point->pdf)) return std::nullopt;
    const Vec3 d = point->p - from;
    LightSample s;
    s.distance = length(d);
    if (!(s.distance > 0)) return std::nullopt;
    s.wi = d * (1 / s.distance);
    s.radiance = emittedAt(point->n, -s.wi);
    if (s.radiance.isBlack()) return std::nullopt;
    s.pdf = point->pdf;
    s.p = point->p;
    s.pError = point->pError;
    s.n = point->n;
    return s;
  }
  float pdfHit(uint32_t element, const Vec3& from, const SurfaceInteraction& hit) const override {
    return shape_.pdfSolidAngle(element, from, hit.p, hit.n);
  }
  Rgb emitted(const SurfaceInteraction& at, const Vec3& w) const override {
    return emittedAt(at.n, w);
  }

  Rgb power(uint32_t element) const override {
    return radiance_ * (kPi * shape_.area(element) * (twoSided_ ? 2.f : 1.f));
  }
  std::optional<LightBounds> bounds(uint32_t element) const override {
    const Shape::NormalCone normals = shape_.normalCone(element);
    LightBounds b;
    b.box = shape_.bounds(element);
    b.axis = normals.axis;
    b.cosThetaO = normals.cosTheta;
    b.cosThetaE = 0;
    b.twoSided = twoSided_;
    b.intensity = radiance_.luminance() * shape_.area(element);
    return b;
  }
  int samples() const override { return samples_; }

 private:
  Rgb emittedAt(const Vec3& n, const Vec3& w) const {
    return twoSided_ || dot(n, w) > 0 ? radiance_ : Rgb();
  }

  const Shape& shape_;
  Rgb radiance_;
  bool twoSided_;
  int samples_;
};

std::unique_ptr<Light> create(const DiffuseLightParameters& p, const AreaLightContext& context) {
  return std::make_unique<DiffuseAreaLight>(
      context.shape, emittedColor(p.radiance, p.scale, context), p.twoSided, p.samples);
}

}  // namespace

AreaLightRegistry::Entry diffuseAreaLightPlugin() {
  return makePlugin("diffuse", "A surface that emits the same radiance in all directions.", create,
                    {"area"});
}

}  // namespace lampyris
