// SPDX-License-Identifier: Apache-2.0
/// The BSSRDFs of materials: a radial profile, and diffuse entry through a dielectric boundary.
#pragma once

#include "base/bssrdf.h"
#include "materials/beam_diffusion.h"
#include "materials/cosine_sampling.h"
#include "materials/fresnel.h"

namespace lampyris {

/// Light that enters through a smooth boundary and is diffuse below (Pharr et al. 2016, §11.4.2):
/// f = (1 − F(θ)) η² / (c π), where c makes the boundary's transmittance 1 for diffuse light. η²
/// takes back the change of radiance where light left.
class DiffuseEntry final : public Lobe {
 public:
  explicit DiffuseEntry(float eta) : Lobe(kReflection | kDiffuse), eta_(eta) {
    const auto transmitted = static_cast<float>(1 - fresnelDiffuse(static_cast<double>(eta)));
    scale = Rgb(eta * eta * kInvPi / transmitted);
  }
  Rgb f(const Vec3&, const Vec3& wi) const override {
    return scale * (1 - fresnelDielectric(wi.z, eta_));
  }
  float pdf(const Vec3& wo, const Vec3& wi) const override { return cosinePdf(sideOf(wo), wi); }
  std::optional<LobeSample> sample(const Vec3& wo, float, const Vec2& u) const override {
    return sampleCosine(*this, sideOf(wo), wo, u);
  }
  float albedo(const Vec3&) const override { return std::min(1.f, scale.luminance()); }

 private:
  float eta_;
};

/// `eta`: the index below the surface.
class SeparableBssrdf : public Bssrdf {
 public:
  explicit SeparableBssrdf(float eta) : eta_(eta) {}
  void addEntryLobe(Bsdf& bsdf) const final { bsdf.add<DiffuseEntry>(eta_); }

 protected:
  ~SeparableBssrdf() = default;

 private:
  float eta_;
};

/// Photon beam diffusion, from a table.
class TabulatedBssrdf final : public SeparableBssrdf {
 public:
  TabulatedBssrdf(const DiffusionTable& table, float eta, const Rgb& sigmaA, const Rgb& sigmaS)
      : SeparableBssrdf(eta),
        sigmaT_{sigmaA.r + sigmaS.r, sigmaA.g + sigmaS.g, sigmaA.b + sigmaS.b},
        rows_{table.profile(safeDivide(sigmaS.r, sigmaT_[0])),
              table.profile(safeDivide(sigmaS.g, sigmaT_[1])),
              table.profile(safeDivide(sigmaS.b, sigmaT_[2]))} {}

  Rgb profile(float r) const override { return {value(0, r), value(1, r), value(2, r)}; }
  std::optional<float> sampleRadius(int channel, float u) const override {
    const auto c = static_cast<size_t>(channel);
    if (!(sigmaT_[c] > 0)) return std::nullopt;
    const auto optical = rows_[c].sample(u);
    if (!optical) return std::nullopt;
    return *optical / sigmaT_[c];
  }
  float pdfRadius(int channel, float r) const override {
    const auto c = static_cast<size_t>(channel);
    return safeDivide(value(c, r), rows_[c].total());
  }

 private:
  float value(size_t channel, float r) const {
    const float optical = r * sigmaT_[channel];
    if (!(optical > 0)) return 0;
    // From distances in mean free paths, by circumference, to area.
    return std::max(0.f, rows_[channel].value(optical)) * sigmaT_[channel] / (2 * kPi * r);
  }
  std::array<float, kChannels> sigmaT_;
  std::array<SplineGrid::Row, kChannels> rows_;
};

/// Two exponentials fitted to diffusion: Christensen and Burley 2015, "Approximate Reflectance
/// Profiles for Efficient Subsurface Scattering", with pbrt-v3's factor 0.2 on the distance.
class BurleyBssrdf final : public SeparableBssrdf {
 public:
  /// A channel of distance 0 scatters within a thousandth of the largest.
  BurleyBssrdf(const Rgb& reflectance, const Rgb& distance, float eta)
      : SeparableBssrdf(eta), reflectance_(reflectance) {
    const float least = 1e-3f * distance.maxComponent();
    d_ = {0.2f * std::max(distance.r, least), 0.2f * std::max(distance.g, least),
          0.2f * std::max(distance.b, least)};
  }
  Rgb profile(float r) const override {
    return reflectance_ * Rgb(pdfRadius(0, r), pdfRadius(1, r), pdfRadius(2, r));
  }
  std::optional<float> sampleRadius(int channel, float u) const override {
    const float d = d_[static_cast<size_t>(channel)];
    const bool narrow = u < 0.25f;
    const float v = std::min(narrow ? 4 * u : (u - 0.25f) / 0.75f, kOneMinusEpsilon);
    return (narrow ? d : 3 * d) * -std::log1p(-v);
  }
  float pdfRadius(int channel, float r) const override {
    const float d = d_[static_cast<size_t>(channel)];
    // The density has a pole at 0.
    const float q = std::max(r / d, 1e-6f);
    return (std::exp(-q) + std::exp(-q / 3)) / (8 * kPi * d * d * q);
  }

 private:
  Rgb reflectance_;
  std::array<float, kChannels> d_;
};

}  // namespace lampyris
