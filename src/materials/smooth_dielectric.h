// SPDX-License-Identifier: Apache-2.0
/// Reflection and refraction at a smooth boundary of dielectrics, each with a colour.
#pragma once

#include "base/bsdf.h"
#include "materials/fresnel.h"

namespace lampyris {

/// Draws reflection or refraction in proportion to Fresnel's share times the colour. Either colour
/// may be black. `eta` is the index below the surface in relation to above; with 1 all light passes
/// straight on.
class SmoothDielectric final : public Lobe {
 public:
  SmoothDielectric(const Rgb& reflectance, const Rgb& transmittance, float eta)
      : Lobe(static_cast<uint8_t>(kSpecular | (reflectance.isBlack() ? 0 : kReflection) |
                                  (transmittance.isBlack() ? 0 : kTransmission))),
        reflectance_(reflectance),
        transmittance_(transmittance),
        eta_(eta) {}

  Rgb f(const Vec3&, const Vec3&) const override { return {}; }
  float pdf(const Vec3&, const Vec3&) const override { return 0; }

  std::optional<LobeSample> sample(const Vec3& wo, float uc, const Vec2&) const override {
    if (wo.z == 0) return std::nullopt;
    const float fresnel = fresnelDielectric(wo.z, eta_);
    const float reflected = fresnel * reflectance_.luminance();
    const float transmitted = (1 - fresnel) * transmittance_.luminance();
    const float total = reflected + transmitted;
    if (!(total > 0)) return std::nullopt;
    const float p = reflected / total;
    if (uc < p) {
      const Rgb f = scale * reflectance_ * (fresnel / std::abs(wo.z));
      return LobeSample{{-wo.x, -wo.y, wo.z}, f, p, kReflection | kSpecular, 1};
    }
    const float eta = wo.z > 0 ? eta_ : 1 / eta_;
    const Vec3 wi = refract(wo);
    if (wi.z == 0) return std::nullopt;
    // Radiance is compressed into the smaller solid angle of the denser side.
    const Rgb f = scale * transmittance_ * ((1 - fresnel) / (eta * eta * std::abs(wi.z)));
    return LobeSample{wi, f, 1 - p, kTransmission | kSpecular, eta};
  }
  float albedo(const Vec3& wo) const override {
    const float fresnel = fresnelDielectric(wo.z, eta_);
    return (scale * (reflectance_ * fresnel + transmittance_ * (1 - fresnel))).luminance();
  }

 private:
  /// Snell's law at the plane z = 0; not called beyond the critical angle.
  Vec3 refract(const Vec3& wo) const {
    if (eta_ == 1) return -wo;
    const float eta = wo.z > 0 ? eta_ : 1 / eta_;
    const SquaredIndex index(wo.z, eta_);
    const float cosT = std::sqrt(std::max(0.f, index.refracted(wo.z)) / index.square);
    return {-wo.x / eta, -wo.y / eta, wo.z > 0 ? -cosT : cosT};
  }
  Rgb reflectance_, transmittance_;
  float eta_;
};

}  // namespace lampyris
