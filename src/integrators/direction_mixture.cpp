// SPDX-License-Identifier: Apache-2.0
#include "integrators/direction_mixture.h"

#include "core/rejections.h"

namespace lampyris {

DrawnDirection DirectionMixture::drawn(const Vec3& wi, const Rgb& scattered, float ownPdf) const {
  DrawnDirection d;
  d.wi = wi;
  d.scattered = scattered;
  d.ownPdf = ownPdf;
  d.guidePdf = guidePdf(wi);
  d.pdf = mixed(ownPdf, d.guidePdf);
  return d;
}

std::optional<DrawnDirection> DirectionMixture::sampleOwn(float uc, const Vec2& u) const {
  if (!at_.bsdf()) {
    const Vec3 wi = at_.phase()->sample(at_.wo(), u);
    const float p = at_.phase()->p(at_.wo(), wi);
    return drawn(wi, Rgb(p), p);
  }
  const auto s = at_.bsdf()->sample(at_.wo(), uc, u);
  if (!s) return std::nullopt;
  const Rgb scattered = s->f * at_.bsdf()->absCosTheta(s->wi);
  DrawnDirection d;
  if (s->isSpecular()) {
    // No other technique finds a specular direction: only the choice of this one counts.
    d.wi = s->wi;
    d.scattered = scattered;
    d.pdf = ownShare_ * s->pdf;
    d.ownPdf = s->pdf;
    d.isSpecular = true;
  } else {
    d = drawn(s->wi, scattered, s->pdf);
  }
  d.isTransmission = s->isTransmission();
  if (d.isTransmission) d.etaScale = sqr(s->eta);
  return d;
}

std::optional<DrawnDirection> DirectionMixture::sample(float uc, const Vec2& u,
                                                       NumberSequence& more) const {
  std::optional<DrawnDirection> d;
  if (uc < ownShare_) {
    d = sampleOwn(std::min(uc / ownShare_, kOneMinusEpsilon), u);
  } else {
    const float part = std::min((uc - ownShare_) / (1 - ownShare_), kOneMinusEpsilon);
    const Vec3 wi = guide_->sample(part, u, more);
    d = drawn(wi, at_.scattered(wi), at_.pdf(wi));
  }
  if (!d || d->scattered.isBlack()) return std::nullopt;
  if (!(d->pdf > 0) || !std::isfinite(d->pdf)) {
    countRejection(Rejection::ScatteringDensity);
    return std::nullopt;
  }
  return d;
}

}  // namespace lampyris
