// SPDX-License-Identifier: Apache-2.0
#include "integrators/direction_mixture.h"

namespace lampyris {

std::optional<DrawnDirection> DirectionMixture::sampleOwn(float uc, const Vec2& u) const {
  if (!at_.bsdf()) {
    const Vec3 wi = at_.phase()->sample(at_.wo(), u);
    const float p = at_.phase()->p(at_.wo(), wi);
    return DrawnDirection{wi, Rgb(p), mixed(p, wi), p};
  }
  const auto s = at_.bsdf()->sample(at_.wo(), uc, u);
  if (!s) return std::nullopt;
  DrawnDirection d{s->wi, s->f * at_.bsdf()->absCosTheta(s->wi), 0, s->pdf, s->isSpecular()};
  d.isTransmission = s->isTransmission();
  if (d.isTransmission) d.etaScale = sqr(s->eta);
  // No other technique finds a specular direction: only the choice of this one counts.
  d.pdf = d.isSpecular ? ownShare_ * s->pdf : mixed(s->pdf, s->wi);
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
    const float own = at_.pdf(wi);
    d = DrawnDirection{wi, at_.scattered(wi), mixed(own, wi), own};
  }
  if (!d || !(d->pdf > 0) || !std::isfinite(d->pdf) || d->scattered.isBlack()) return std::nullopt;
  return d;
}

}  // namespace lampyris
