// SPDX-License-Identifier: Apache-2.0
#include "guiding/lobe_mixture.h"

namespace lampyris {

bool LobeMixture::moveTo(const GuidePoint& point, const DirectionWeight& scattering) {
  count_ = 0;
  total_ = 0;
  add(cache_.find(point.p, point.n), point.n, scattering);
  if (point.onSurface() && point.transmits)
    add(cache_.find(point.p, -point.n), -point.n, scattering);
  if (!(total_ > 0) || !std::isfinite(1 / total_)) return false;
  for (size_t i = 0; i < count_; ++i) {
    lobes_[i].weight /= total_;
    lobes_[i].normalisation *= lobes_[i].weight;
  }
  return true;
}

/// Adds lobes that count above a plane with normal `n` (zero: everywhere).
void LobeMixture::add(const SignificanceCache::Lobes& cell, const Vec3& n,
                      const DirectionWeight& scattering) {
  // Equal but for rounding: V is known.
  const bool samePlane = lengthSquared(n - cell.n) < 1e-13f;
  for (const SignificanceCache::Lobe& r : cell.lobes) {
    const float tilt = n == Vec3(0) ? 1.f : dot(r.axis, n);
    if (!(tilt > 0)) continue;
    const float weight = scattering.weight(r.axis) * r.flux;
    if (!(weight > 0) || !std::isfinite(weight)) continue;
    total_ += weight;
    lobes_[count_++] = {r.axis, n, r.level, weight,
                        samePlane ? r.inverse : inverseClippedLobe(r.level, tilt)};
  }
}

Vec3 LobeMixture::sample(float u, const Vec2& v, NumberSequence& more) const {
  size_t i = 0;
  for (; i + 1 < count_ && u >= lobes_[i].weight; ++i) u -= lobes_[i].weight;
  const Lobe& l = lobes_[i];
  return l.n == Vec3(0) ? sampleLobe(l.level, l.axis, v)
                        : sampleClippedLobe(l.level, l.axis, l.n, v, more);
}

float LobeMixture::pdf(const Vec3& wi) const {
  float sum = 0;
  for (size_t i = 0; i < count_; ++i) {
    const Lobe& l = lobes_[i];
    if (l.n == Vec3(0) || dot(wi, l.n) > 0) sum += l.normalisation * lobePower(l.level, l.axis, wi);
  }
  return sum;
}

}  // namespace lampyris
