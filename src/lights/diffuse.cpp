// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "base/light.h"
#include "core/frame.h"
#include "core/huge_page_object.h"
#include "core/sampling.h"
#include "lights/emission.h"
#include "lights/surface_emission.h"

namespace lampyris {
namespace {

struct DiffuseLightParameters {
  RgbInput radiance{1};
  Rgb scale{1};
  std::string filename;
  bool twoSided = false;
  int samples = 1;
  void declare(Declaration& d) {
    declareColor(
        d, "L", radiance,
        "Emitted radiance, W/(m² sr): a colour, a spectrum texture, or a factor on the picture.",
        scale);
    d.add("filename", filename,
          "Picture that the surface emits: PNG, JPG, TGA, BMP (sRGB-encoded), HDR, EXR or PFM. It "
          "lies in the (u, v) square and repeats beyond.")
        .rangeIs("any file name, or none");
    d.add("twosided", twoSided, "Whether the side against the normal emits as well.");
    d.add("samples", samples, "Wish for samples a point in direct lighting.")
        .alias("nsamples")
        .range(1, 1e6);
  }
};

/// Largest radiant intensity of an emitter without its own shadow, over radiance × area: the mean
/// cosine of normals that are spread evenly over a cone. 1 for flat ones, 1/4 for spheres. Two
/// sides change nothing: where both face the viewer, one of them hides the other.
float projectedShare(float cosTheta) {
  return cosTheta >= 0 ? (1 + cosTheta) / 2 : 1 / (2 * (1 - cosTheta));
}

/// All elements of a shape, which stand for one light each unless the shape can be sampled as a
/// whole. For those of constant radiance nothing is kept.
class DiffuseAreaLight final : public Light, public HugePageObject {
 public:
  /// `varying` in place of `radiance` if it is not null.
  DiffuseAreaLight(const Shape& shape, const Rgb& radiance,
                   std::unique_ptr<const SurfaceEmission> varying, bool twoSided, int samples)
      : whole_(varying ? nullptr : shape.whole()),
        surface_(whole_ ? *whole_ : shape),
        radiance_(radiance),
        varying_(std::move(varying)),
        twoSided_(twoSided),
        samples_(samples) {}

  uint32_t elementCount() const override { return surface_.elementCount(); }
  bool isDelta() const override { return false; }

  const void* beyond() const override { return &surface_; }
  std::optional<LightSample> sample(uint32_t element, const Vec3& from,
                                    const Vec2& u) const override {
    std::optional<LightSample> out;
    const auto point = surface_.sampleSolidAngle(element, from, u);
    if (!point || !(point->pdf > 0) || !std::isfinite(point->pdf)) return out;
    const Vec3 d = point->p - from;
    const float distance = length(d);
    if (!(distance > 0)) return out;
    const Vec3 wi = d * (1 / distance);
    if (!emitsTowards(point->n, -wi)) return out;
    const Rgb radiance = varying_ ? varying_->at(element, point->p, point->n) : radiance_;
    if (radiance.isBlack()) return out;
    LightSample& s = out.emplace();
    s.radiance = radiance;
    s.wi = wi;
    s.distance = distance;
    s.pdf = point->pdf;
    s.p = point->p;
    s.pError = point->pError;
    s.n = point->n;
    return out;
  }
  float pdfHit(uint32_t element, const Vec3& from, const SurfaceInteraction& hit) const override {
    return surface_.pdfSolidAngle(element, from, hit.p, hit.n);
  }
  Rgb emitted(const SurfaceInteraction& at, const Vec3& w) const override {
    if (!emitsTowards(at.n, w)) return Rgb();
    return varying_ ? varying_->at(at) : radiance_;
  }

  std::optional<EmissionSample> sampleEmission(uint32_t element, const Vec2& u,
                                               const Vec2& v) const override {
    const auto point = surface_.sampleArea(element, u);
    if (!point || !(point->pdf > 0) || !std::isfinite(point->pdf)) return std::nullopt;
    EmissionSample s;
    s.radiance = varying_ ? varying_->at(element, point->p, point->n) : radiance_;
    // Two sides share the numbers of the first variate.
    const bool back = twoSided_ && v.x >= 0.5f;
    const Vec2 shared(std::min(2 * v.x - (back ? 1.f : 0.f), kOneMinusEpsilon), v.y);
    const Vec3 local = sampleCosineHemisphere(twoSided_ ? shared : v);
    if (s.radiance.isBlack() || !(local.z > 0)) return std::nullopt;
    s.p = point->p;
    s.pError = point->pError;
    s.n = point->n;
    s.w = Frame::fromZ(back ? -point->n : point->n).toWorld(local);
    s.pdfPosition = point->pdf;
    s.pdfDirection = pdfDirection(s.n, s.w);
    if (!(s.pdfDirection > 0)) return std::nullopt;
    return s;
  }
  EmissionPdf emissionPdf(uint32_t element, const Vec3& n, const Vec3& w) const override {
    return {surface_.pdfArea(element, n), pdfDirection(n, w)};
  }

  Rgb power(uint32_t element) const override {
    return meanRadiance(element) * (kPi * surface_.area(element) * (twoSided_ ? 2.f : 1.f));
  }
  std::optional<LightBounds> bounds(uint32_t element) const override {
    const SampledSurface::NormalCone normals = surface_.normalCone(element);
    LightBounds b;
    b.box = surface_.bounds(element);
    b.axis = normals.axis;
    b.cosThetaO = normals.cosTheta;
    b.cosThetaE = 0;
    b.twoSided = twoSided_;
    b.intensity = meanRadiance(element).luminance() * surface_.area(element) *
                  projectedShare(normals.cosTheta);
    return b;
  }
  int samples() const override { return samples_; }

 private:
  bool emitsTowards(const Vec3& n, const Vec3& w) const { return twoSided_ || dot(n, w) > 0; }
  float pdfDirection(const Vec3& n, const Vec3& w) const {
    const float cosine = dot(n, w);
    return cosineHemispherePdf(twoSided_ ? std::abs(cosine) / 2 : std::max(cosine, 0.f));
  }
  /// Grey where it varies.
  Rgb meanRadiance(uint32_t element) const {
    return varying_ ? Rgb(varying_->meanLuminance(element)) : radiance_;
  }

  std::unique_ptr<const SampledSurface> whole_;
  const SampledSurface& surface_;
  Rgb radiance_;
  std::unique_ptr<const SurfaceEmission> varying_;
  bool twoSided_;
  int samples_;
};

std::unique_ptr<const SurfaceEmission> makePicture(const std::string& name, const Rgb& scale,
                                                   const AreaLightContext& context) {
  auto picture = EmissionImage::load(name, EmissionImage::Encoding::Srgb, context.images, context);
  // One table for all shapes that emit the picture alike.
  const std::string key =
      fmt::format("{} {} {} {}", fmt::ptr(picture.get()), scale.r, scale.g, scale.b);
  const auto means = context.images.shared<PictureMeans>(
      key, [&] { return std::make_shared<const PictureMeans>(picture, scale); });
  return std::make_unique<SurfaceEmission>(context.shape, std::move(picture), scale, *means);
}

std::unique_ptr<Light> create(const DiffuseLightParameters& p, const AreaLightContext& context) {
  const TexturedRgb radiance = context.textures.resolve(p.radiance);
  if (radiance.texture && !p.filename.empty())
    throw SceneError(context.location,
                     "the area light has both a \"texture L\" and a \"filename\": give one of them "
                     "(\"scale\" works with either)");
  const Rgb factor = emittedColor(radiance.texture ? Rgb(1) : radiance.value, p.scale, context);
  std::unique_ptr<const SurfaceEmission> varying;
  if (radiance.texture)
    varying = std::make_unique<SurfaceEmission>(context.shape, *radiance.texture, factor);
  else if (!p.filename.empty())
    varying = makePicture(p.filename, factor, context);
  return std::make_unique<DiffuseAreaLight>(context.shape, factor, std::move(varying), p.twoSided,
                                            p.samples);
}

/// Elsewhere the last of two parameters of one name counts; a colour and a texture are two wishes.
void checkRadiance(const ParameterSet& set) {
  const Parameter* first = nullptr;
  for (const Parameter& p : set.parameters) {
    if (p.name != "L") continue;
    if (!first) first = &p;
    if ((p.type == ParameterType::Texture) != (first->type == ParameterType::Texture))
      throw SceneError(p.location,
                       "the area light has L as a colour and as a texture: give one of them, and "
                       "\"scale\" as a factor");
  }
}

}  // namespace

AreaLightRegistry::Entry diffuseAreaLightPlugin() {
  auto plugin = makePlugin("diffuse", "A surface that emits the same radiance in all directions.",
                           create, {"area"});
  plugin.create = [inner = plugin.create](const ParameterSet& set,
                                          const AreaLightContext& context) {
    checkRadiance(set);
    return inner(set, context);
  };
  return plugin;
}

}  // namespace lampyris
