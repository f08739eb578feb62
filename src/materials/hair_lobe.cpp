// SPDX-License-Identifier: Apache-2.0
#include "materials/hair_lobe.h"

#include <cmath>

#include "materials/fresnel.h"

namespace lampyris {

namespace {

/// x^n for the fits of the roughnesses.
float power(float x, int n) {
  float result = 1;
  for (; n > 0; n >>= 1, x *= x)
    if (n & 1) result *= x;
  return result;
}

/// log I₀(x) of the modified Bessel function, x ≥ 0: its series, or the asymptotic expansion where
/// three terms of it are right to four digits.
float logBesselI0(float x) {
  if (x > 12) return x - 0.5f * std::log(2 * kPi * x) + std::log1p((1 + 4.5f / (8 * x)) / (8 * x));
  const float q = x * x / 4;
  float term = 1, sum = 1;
  for (int i = 1; term > 1e-7f * sum; ++i) {
    term *= q / sqr(static_cast<float>(i));
    sum += term;
  }
  return std::log(sum);
}

/// The logistic distribution around 0, restricted to [−π, π].
class TrimmedLogistic {
 public:
  explicit TrimmedLogistic(float s) : s_(s), below_(cdf(-kPi)), inside_(1 - 2 * below_) {}
  float pdf(float x) const {
    const float e = std::exp(-std::abs(x) / s_);
    return e / (s_ * sqr(1 + e) * inside_);
  }
  float sample(float u) const {
    const float c = below_ + u * inside_;
    return c > 0 ? std::clamp(-s_ * std::log(1 / c - 1), -kPi, kPi) : -kPi;
  }

 private:
  float cdf(float x) const { return 1 / (1 + std::exp(-x / s_)); }
  float s_, below_, inside_;
};

/// An angle brought into [−π, π].
float wrapped(float phi) { return std::remainder(phi, 2 * kPi); }

}  // namespace

/// Sine and cosine of the angle to the plane across the hair.
struct HairLobe::Angles {
  float sin, cos;
  explicit Angles(const Vec3& w) : sin(w.x), cos(std::sqrt(std::max(0.f, w.y * w.y + w.z * w.z))) {}
  Angles(float s, float c) : sin(s), cos(c) {}
};

namespace {

/// d'Eon et al. 2011, eq. 7: the density of sin θi (from −1 to 1) around −sin θo. In terms of
/// logarithms, because the factors of narrow lobes overflow.
template <class A>
float longitudinal(const A& i, const A& o, float v) {
  const float a = i.cos * o.cos / v, b = i.sin * o.sin / v;
  // 1 / (2 v sinh(1/v)) = e^(−1/v) / (v (1 − e^(−2/v))).
  return std::exp(logBesselI0(a) - b - 1 / v) / (v * (1 - std::exp(-2 / v)));
}

}  // namespace

/// What depends on the outgoing direction alone.
struct HairLobe::Incidence {
  Angles angles;
  float phi, gammaT;
  std::array<Rgb, kPaths> attenuation;
  std::array<float, kPaths> probability;
};

HairLobe::HairLobe(const Parameters& p)
    : Lobe(kReflection | kTransmission | kGlossy | kAllAround),
      h_(p.h),
      gammaO_(safeAsin(p.h)),
      eta_(p.eta),
      sigmaA_(p.sigmaA) {
  // The paper's fits of perceptually uniform roughnesses, eqs. 7 and 8.
  const float v = sqr(0.726f * p.betaM + 0.812f * sqr(p.betaM) + 3.7f * power(p.betaM, 20));
  variance_ = {v, 0.25f * v, 4 * v};
  azimuthalScale_ =
      std::sqrt(kPi / 8) * (0.265f * p.betaN + 1.194f * sqr(p.betaN) + 5.372f * power(p.betaN, 22));
  for (size_t k = 0; k < 3; ++k) {
    const float angle = radians(p.alpha) * static_cast<float>(1 << k);
    sinTilt_[k] = std::sin(angle);
    cosTilt_[k] = std::cos(angle);
  }
}

/// Attenuation along the paths (Chiang et al. 2016, §3.3): Fresnel's terms at each boundary and
/// absorption on each way through; the last sums the geometric series of the rest.
HairLobe::Incidence HairLobe::incidence(const Vec3& wo) const {
  Incidence o{Angles(wo), std::atan2(wo.z, wo.y), 0, {}, {}};
  const float sinThetaT = o.angles.sin / eta_;
  const float cosThetaT = std::sqrt(std::max(0.f, 1 - sqr(sinThetaT)));
  // The index that a ray projected across the hair sees (Marschner et al. 2003, appendix B).
  const float projected = std::sqrt(std::max(0.f, sqr(eta_) - sqr(o.angles.sin)));
  const float sinGammaT = projected > 0 ? std::clamp(h_ * o.angles.cos / projected, -1.f, 1.f) : 0;
  const float cosGammaT = std::sqrt(std::max(0.f, 1 - sqr(sinGammaT)));
  o.gammaT = safeAsin(sinGammaT);
  const float way = cosThetaT > 0 ? 2 * cosGammaT / cosThetaT : 0;
  const Rgb t = exp(sigmaA_ * -way);

  const float cosGammaO = std::sqrt(std::max(0.f, 1 - sqr(h_)));
  const float f = fresnelDielectric(o.angles.cos * cosGammaO, eta_);
  o.attenuation[0] = Rgb(f);
  o.attenuation[1] = sqr(1 - f) * t;
  o.attenuation[2] = o.attenuation[1] * t * f;
  const Rgb reflected = t * f;
  // At f = 1 nothing is left to go on, and the quotient would be 0/0.
  for (float Rgb::*c : {&Rgb::r, &Rgb::g, &Rgb::b})
    o.attenuation[3].*c = safeDivide(o.attenuation[2].*c * reflected.*c, 1 - reflected.*c);

  float total = 0;
  for (const Rgb& a : o.attenuation) total += a.luminance();
  for (size_t p = 0; p < kPaths; ++p)
    o.probability[p] = safeDivide(o.attenuation[p].luminance(), total);
  return o;
}

/// The scales of the cuticle turn each path's cone: by −2α, α, 4α (Marschner et al. 2003).
HairLobe::Angles HairLobe::tilted(const Angles& o, int path) const {
  if (path == 3) return o;
  const size_t k = path == 0 ? 1 : path == 1 ? 0 : 2;
  const float s = path == 0 ? -sinTilt_[k] : sinTilt_[k], c = cosTilt_[k];
  return {o.sin * c + o.cos * s, std::abs(o.cos * c - o.sin * s)};
}

/// The azimuth by which a path turns: refraction in and out, half a turn at each reflection.
float HairLobe::azimuth(int path, float gammaT) const {
  const auto p = static_cast<float>(path);
  return 2 * p * gammaT - 2 * gammaO_ + p * kPi;
}

template <class T>
T HairLobe::sum(const Incidence& o, const Vec3& wi, const std::array<T, kPaths>& weights) const {
  const Angles i(wi);
  const float phi = std::atan2(wi.z, wi.y) - o.phi;
  const TrimmedLogistic around(azimuthalScale_);
  T total{};
  for (int p = 0; p < kPaths; ++p) {
    const auto n = static_cast<size_t>(p);
    const float m = longitudinal(i, tilted(o.angles, p), variance_[std::min<size_t>(n, 2)]);
    const float a = p < 3 ? around.pdf(wrapped(phi - azimuth(p, o.gammaT))) : 1 / (2 * kPi);
    total += weights[n] * (m * a);
  }
  return total;
}

Rgb HairLobe::f(const Vec3& wo, const Vec3& wi) const {
  if (wi.z == 0) return {};
  const Incidence o = incidence(wo);
  // The model has its cosine in itself.
  return scale * sum(o, wi, o.attenuation) / std::abs(wi.z);
}

float HairLobe::pdf(const Vec3& wo, const Vec3& wi) const {
  const Incidence o = incidence(wo);
  return sum(o, wi, o.probability);
}

std::optional<LobeSample> HairLobe::sample(const Vec3& wo, float uc, const Vec2& u) const {
  const Incidence o = incidence(wo);
  int p = 0;
  while (p < 3 && uc >= o.probability[static_cast<size_t>(p)])
    uc -= o.probability[static_cast<size_t>(p++)];
  const auto n = static_cast<size_t>(p);
  if (!(o.probability[n] > 0)) return std::nullopt;
  const float ua = std::clamp(uc / o.probability[n], 0.f, kOneMinusEpsilon);

  // Around the mirrored cone: d'Eon 2013, "A Fiber Scattering Model with Non-Separable Lobes".
  const Angles t = tilted(o.angles, p);
  const float v = variance_[std::min<size_t>(n, 2)];
  const float z = std::max(-1.f, 1 + v * std::log(u.x + (1 - u.x) * std::exp(-2 / v)));
  const float across = std::sqrt(std::max(0.f, 1 - z * z)) * std::cos(2 * kPi * u.y);
  const float sinI = std::clamp(-z * t.sin + across * t.cos, -1.f, 1.f);
  const float cosI = std::sqrt(std::max(0.f, 1 - sinI * sinI));
  const float phi =
      o.phi +
      (p < 3 ? azimuth(p, o.gammaT) + TrimmedLogistic(azimuthalScale_).sample(ua) : 2 * kPi * ua);
  const Vec3 wi(sinI, cosI * std::cos(phi), cosI * std::sin(phi));
  const float density = sum(o, wi, o.probability);
  if (wi.z == 0) return std::nullopt;
  const uint8_t side = sameHemisphere(wo, wi) ? kReflection : kTransmission;
  return LobeSample{wi, scale * sum(o, wi, o.attenuation) / std::abs(wi.z), density,
                    static_cast<uint8_t>(kGlossy | side), 1};
}

Rgb hairAbsorptionOfColor(const Rgb& c, float betaN) {
  const float fit =
      5.969f +
      betaN * (-0.215f + betaN * (2.532f + betaN * (-10.73f + betaN * (5.574f + betaN * 0.245f))));
  // Black would absorb infinitely; what is brighter than white would glow.
  const auto absorption = [fit](float v) { return sqr(std::log(std::clamp(v, 1e-6f, 1.f)) / fit); };
  return {absorption(c.r), absorption(c.g), absorption(c.b)};
}

Rgb hairAbsorptionOfMelanin(float eumelanin, float pheomelanin) {
  constexpr Rgb kEumelanin(0.419f, 0.697f, 1.37f), kPheomelanin(0.187f, 0.4f, 1.05f);
  return eumelanin * kEumelanin + pheomelanin * kPheomelanin;
}

}  // namespace lampyris
