// SPDX-License-Identifier: Apache-2.0
#include "integrators/direction_mixture.h"

#include "core/rejections.h"

namespace lampyris {

void DirectionMixture::set(DrawnDirection& d, const Vec3& wi, const Rgb& scattered,
                           float ownPdf) const {
  d.wi = wi;
  d.scattered = scattered;
  d.ownPdf = ownPdf;
  d.guidePdf = guidePdf(wi);
  d.pdf = mixed(ownPdf, d.guidePdf);
}

/// Leaves `d` black where nothing is scattered.
void DirectionMixture::sampleOwn(DrawnDirection& d, float uc, const Vec2& u) const {
  if (!at_.bsdf) {
    const Vec3 wi = at_.phase->sample(at_.wo, u);
    const float p = at_.phase->p(at_.wo, wi);
    set(d, wi, Rgb(p), p);
    return;
  }
  const auto s = at_.bsdf->sample(at_.wo, uc, u);
  if (!s) return;
  const Rgb scattered = s->f * at_.bsdf->absCosTheta(s->wi);
  if (s->isSpecular()) {
    // No other technique finds a specular direction: only the choice of this one counts.
    d.wi = s->wi;
    d.scattered = scattered;
    d.pdf = ownShare_ * s->pdf;
    d.ownPdf = s->pdf;
    d.isSpecular = true;
  } else {
    set(d, s->wi, scattered, s->pdf);
  }
  d.isTransmission = s->isTransmission();
  if (d.isTransmission) d.etaScale = sqr(s->eta);
}

std::optional<DrawnDirection> DirectionMixture::sample(float uc, const Vec2& u,
                                                       NumberSequence& more) const {
  std::optional<DrawnDirection> out;
  DrawnDirection& d = out.emplace();
  if (uc < ownShare_) {
    sampleOwn(d, std::min(uc / ownShare_, kOneMinusEpsilon), u);
  } else {
    const float part = std::min((uc - ownShare_) / (1 - ownShare_), kOneMinusEpsilon);
    const Vec3 wi = guide_->sample(part, u, more);
    set(d, wi, at_.scattered(wi), at_.pdf(wi));
  }
  if (d.scattered.isBlack()) {
    out.reset();
  } else if (!(d.pdf > 0) || !std::isfinite(d.pdf)) {
    countRejection(Rejection::ScatteringDensity);
    out.reset();
  }
  return out;
}

}  // namespace lampyris
