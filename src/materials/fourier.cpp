// SPDX-License-Identifier: Apache-2.0
// Tabulated BSDFs. A direction is drawn by inverting the elevation's spline and then the azimuth's
// Fourier series, so the density is the value of the luminance over its integral.
#include "materials/fourier_table.h"
#include "materials/surface_material.h"

namespace lampyris {
namespace {

class FourierLobe final : public Lobe {
 public:
  explicit FourierLobe(const FourierTable& table)
      : Lobe(kReflection | kTransmission | kGlossy | kAllAround), table_(&table) {}

  Rgb f(const Vec3& wo, const Vec3& wi) const override {
    const auto series = table_->series(-wi.z, wo.z);
    return series ? value(wo, wi, *series, cosAzimuth(wo, wi)) : Rgb();
  }
  float pdf(const Vec3& wo, const Vec3& wi) const override {
    const auto series = table_->series(-wi.z, wo.z);
    const auto row = table_->row(wo.z);
    return series && row ? density(*row, series->value(0, cosAzimuth(wo, wi))) : 0.f;
  }
  std::optional<LobeSample> sample(const Vec3& wo, float, const Vec2& u) const override {
    const auto row = table_->row(wo.z);
    const auto muI = row ? row->sample(u.x) : std::nullopt;
    const auto series = muI ? table_->series(*muI, wo.z) : std::nullopt;
    if (!series) return std::nullopt;
    std::array<float, FourierTable::kMaxOrders> a;
    const auto azimuth = sampleFourier({a.data(), series->coefficients(a)}, u.y);
    if (!azimuth) return std::nullopt;

    // Turned from wo's azimuth, then reversed: the table is in terms of where light goes.
    const Vec2 x = azimuthOf(wo);
    const auto c = static_cast<float>(std::cos(*azimuth));
    const auto s = static_cast<float>(std::sin(*azimuth));
    const float sine = std::sqrt(std::max(0.f, 1 - *muI * *muI));
    const Vec3 wi(-sine * (c * x.x - s * x.y), -sine * (s * x.x + c * x.y), -*muI);
    const float p = density(*row, series->value(0, static_cast<double>(c)));
    const Rgb f = value(wo, wi, *series, static_cast<double>(c));
    if (!(p > 0) || f.isBlack()) return std::nullopt;
    if (sameHemisphere(wo, wi)) return LobeSample{wi, f, p, kReflection | kGlossy, 1};
    return LobeSample{wi, f, p, kTransmission | kGlossy, etaBehind(wo)};
  }
  float albedo(const Vec3& wo) const override {
    const auto row = table_->row(wo.z);
    const float a = row ? 2 * kPi * row->total() * scale.luminance() : 0.f;
    return std::clamp(a, 0.f, 1.f);
  }

 private:
  /// A unit vector in the tangent plane; x for the normal, where no azimuth is.
  static Vec2 azimuthOf(const Vec3& w) {
    const float length2 = w.x * w.x + w.y * w.y;
    return length2 > 1e-30f ? Vec2(w.x, w.y) / std::sqrt(length2) : Vec2(1, 0);
  }
  static double cosAzimuth(const Vec3& wo, const Vec3& wi) {
    return std::clamp(static_cast<double>(-dot(azimuthOf(wo), azimuthOf(wi))), -1., 1.);
  }
  float etaBehind(const Vec3& wo) const { return wo.z > 0 ? table_->eta() : 1 / table_->eta(); }

  /// By solid angle: elevation and azimuth are drawn in proportion to the luminance.
  static float density(const SplineGrid::Row& row, double luminance) {
    const float total = row.total();
    return total > 0 && luminance > 0 ? static_cast<float>(luminance) / (2 * kPi * total) : 0.f;
  }
  Rgb value(const Vec3& wo, const Vec3& wi, const FourierTable::Series& series,
            double cosPhi) const {
    const auto luminance = static_cast<float>(std::max(0., series.value(0, cosPhi)));
    if (luminance == 0 || wi.z == 0) return {};
    Rgb c(luminance);
    if (table_->isColored()) {
      const auto r = static_cast<float>(series.value(1, cosPhi));
      const auto b = static_cast<float>(series.value(2, cosPhi));
      // Green is what is missing of the luminance (Rec. 709).
      c = clampPositive({r, 1.39829f * luminance - 0.100913f * b - 0.297375f * r, b});
    }
    float factor = 1 / std::abs(wi.z);
    if (!sameHemisphere(wo, wi)) factor /= sqr(etaBehind(wo));  // radiance, not power
    return scale * c * factor;
  }
  const FourierTable* table_;
};

struct FourierParameters : SurfaceParameters {
  std::string file;
  void declare(Declaration& d) {
    d.add("bsdffile", file, "A BSDF file of the format SCATFUN, version 1.")
        .rangeIs("any file name");
    declareSurface(d);
  }
};

std::string pathOf(const FourierParameters& p, const MaterialContext& c) {
  if (p.file.empty())
    throw SceneError(c.location, "material \"fourier\" needs \"string bsdffile\": a .bsdf file");
  return c.resolvePath(p.file);
}

class FourierMaterial final : public SurfaceMaterial {
 public:
  FourierMaterial(const FourierParameters& p, const MaterialContext& c)
      : SurfaceMaterial(p, c), table_(pathOf(p, c)) {}

  void addLobes(const SurfaceInteraction&, Bsdf& bsdf) const override {
    bsdf.add<FourierLobe>(table_);
  }

 private:
  FourierTable table_;
};

}  // namespace

MaterialRegistry::Entry fourierPlugin() {
  return makePlugin("fourier", "A tabulated or measured BSDF, read from a file.",
                    createMaterial<FourierMaterial, FourierParameters>);
}

}  // namespace lampyris
