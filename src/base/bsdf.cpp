// SPDX-License-Identifier: Apache-2.0
// One-sample estimation of a sum of lobes (Veach 1997, §9.2.4): a lobe is drawn in proportion to
// its albedo, and the density is that of the whole mixture. pbrt-v3 draws every lobe equally often;
// the expected value is the same.
#include "base/bsdf.h"

#include <cmath>

#include "core/math.h"
#include "core/rejections.h"

namespace lampyris {

namespace {

/// The rounding error of a dot product of unit vectors: a cosine below has no significant digit.
constexpr float kMinCosine = 1e-7f;
/// Share of the total that every lobe's weight gets on top, because albedo() is an approximation:
/// bounds the weight of a sample from a lobe that was thought to be dark.
constexpr float kAlbedoFloor = 1e-3f;

using Probabilities = std::array<float, Bsdf::kMaxLobes>;

/// The probability of each lobe's choice; all 0 if no lobe scatters.
Probabilities chooseProbabilities(const Bsdf& bsdf, const Vec3& wo) {
  Probabilities p;
  const size_t n = bsdf.lobeCount();
  float total = 0;
  int scattering = 0;
  for (size_t i = 0; i < n; ++i) {
    const float albedo = bsdf.lobe(i).albedo(wo);
    p[i] = albedo > 0 && std::isfinite(albedo) ? albedo : 0.f;
    total += p[i];
    scattering += p[i] > 0;
  }
  if (!(total > 0)) return p;
  const float floor = kAlbedoFloor * total;
  const float normalisation = 1 / (total + static_cast<float>(scattering) * floor);
  for (size_t i = 0; i < n; ++i)
    if (p[i] > 0) p[i] = (p[i] + floor) * normalisation;
  return p;
}

/// Which lobes light from wi to wo may pass.
class SideRule {
 public:
  SideRule(float geometricProduct, float shadingProduct)
      : reflected_(geometricProduct > 0), consistent_(reflected_ == (shadingProduct > 0)) {}

  /// A lobe that does both tells reflection from transmission by the shading normal: where the
  /// geometric one disagrees it must not count, unless it makes no difference between the two.
  bool allows(const Lobe& lobe) const {
    constexpr uint8_t kBoth = kReflection | kTransmission;
    if ((lobe.flags & kBoth) == kBoth) return consistent_ || (lobe.flags & kAllAround);
    return lobe.flags & (reflected_ ? kReflection : kTransmission);
  }

 private:
  bool reflected_, consistent_;
};

/// A unit vector along `d` without its part along the unit vector `z`; any where there is none.
Vec3 tangentAlong(const Vec3& d, const Vec3& z) {
  Vec3 x = d - dot(d, z) * z;
  const float x2 = lengthSquared(x), d2 = lengthSquared(d);
  if (x2 > 0.01f * d2 && x2 > 1e-30f && d2 < 1e30f) return x * (1 / std::sqrt(x2));
  // Nearly parallel to z or of extreme length: twice is enough (Gram-Schmidt).
  const Vec3 unit = normalize(d);
  x = unit - dot(unit, z) * z;
  if (lengthSquared(x) > 1e-10f) {
    x = normalize(x);
    return normalize(x - dot(x, z) * z);
  }
  Vec3 y;
  completeBasis(z, x, y);
  return x;
}

}  // namespace

size_t Lobe::shapes(const Vec3& wo, std::span<LobeShape, kMaxShapes> out) const {
  if (flags & kSpecular) return 0;
  size_t count = 0;
  const bool both = (flags & kReflection) && (flags & kTransmission);
  LobeShape shape;
  shape.albedo = both ? 0.5f * albedo(wo) : albedo(wo);
  for (const LobeFlags side : {kReflection, kTransmission}) {
    if (!(flags & side)) continue;
    shape.transmitted = side == kTransmission;
    out[count++] = shape;
  }
  return count;
}

void Bsdf::reset(const SurfaceInteraction& at) {
  ng_ = at.n;
  // A zero or undefined shading normal would make every direction vanish.
  frame_.z = lengthSquared(at.shading.n) > 0.5f ? at.shading.n : at.n;
  frame_.x = tangentAlong(at.shading.dpdu, frame_.z);
  frame_.y = cross(frame_.z, frame_.x);
  flags_ = 0;
  count_ = 0;
}

void Bsdf::scaleLobes(size_t first, const Rgb& by) {
  for (size_t i = first; i < count_; ++i) lobes_[i]->scale *= by;
}

bool Bsdf::isSpecular() const {
  for (size_t i = 0; i < count_; ++i)
    if (!(lobes_[i]->flags & kSpecular)) return false;
  return true;
}

Rgb Bsdf::f(const Vec3& woWorld, const Vec3& wiWorld) const {
  const Vec3 wo = frame_.toLocal(woWorld), wi = frame_.toLocal(wiWorld);
  if (std::abs(wo.z) < kMinCosine) return {};
  const SideRule side(dot(woWorld, ng_) * dot(wiWorld, ng_), wo.z * wi.z);
  if (count_ == 1) {
    const Lobe& only = *lobes_[0];
    return side.allows(only) ? only.f(wo, wi) : Rgb();
  }
  Rgb sum;
  for (size_t i = 0; i < count_; ++i) {
    const Lobe& l = *lobes_[i];
    if (!(l.flags & kSpecular) && side.allows(l)) sum += l.f(wo, wi);
  }
  return sum;
}

float Bsdf::pdf(const Vec3& woWorld, const Vec3& wiWorld) const {
  const Vec3 wo = frame_.toLocal(woWorld), wi = frame_.toLocal(wiWorld);
  if (count_ == 0 || std::abs(wo.z) < kMinCosine) return 0;
  if (count_ == 1) return lobes_[0]->pdf(wo, wi);
  const Probabilities p = chooseProbabilities(*this, wo);
  float sum = 0;
  for (size_t i = 0; i < count_; ++i)
    if (p[i] > 0 && !(lobes_[i]->flags & kSpecular)) sum += p[i] * lobes_[i]->pdf(wo, wi);
  return sum;
}

std::optional<BsdfSample> Bsdf::sample(const Vec3& woWorld, float uc, const Vec2& u) const {
  std::optional<BsdfSample> out;
  const Vec3 wo = frame_.toLocal(woWorld);
  if (count_ == 0 || std::abs(wo.z) < kMinCosine) return out;

  Probabilities p;
  size_t chosen = 0;
  p[0] = 1;
  if (count_ > 1) {
    p = chooseProbabilities(*this, wo);
    // Walks down the probabilities; rounding at the end leaves the last lobe that can be chosen.
    float below = 0, before = 0;
    chosen = count_;
    for (size_t i = 0; i < count_; ++i) {
      if (!(p[i] > 0)) continue;
      chosen = i;
      before = below;
      below += p[i];
      if (uc < below) break;
    }
    if (chosen == count_) return out;
    uc = std::clamp((uc - before) / p[chosen], 0.f, kOneMinusEpsilon);
  }

  const auto s = lobes_[chosen]->sample(wo, uc, u);
  if (!s) return out;
  const Vec3 wi = frame_.toWorld(s->wi);
  Rgb f = s->f;
  float pdf = p[chosen] * s->pdf;
  if (!(s->flags & kSpecular)) {
    const SideRule side(dot(woWorld, ng_) * dot(wi, ng_), wo.z * s->wi.z);
    if (!side.allows(*lobes_[chosen])) f = Rgb();
    for (size_t i = 0; i < count_; ++i) {
      const Lobe& l = *lobes_[i];
      if (i == chosen || (l.flags & kSpecular)) continue;
      if (p[i] > 0) pdf += p[i] * l.pdf(wo, s->wi);
      if (side.allows(l)) f += l.f(wo, s->wi);
    }
  }
  if (f.isBlack()) return out;
  if (!(pdf > 0) || !std::isfinite(pdf)) {
    countRejection(Rejection::ScatteringDensity);
    return out;
  }
  BsdfSample& drawn = out.emplace();
  drawn.wi = wi;
  drawn.f = f;
  drawn.pdf = pdf;
  drawn.flags = s->flags;
  drawn.eta = s->eta;
  return out;
}

}  // namespace lampyris
