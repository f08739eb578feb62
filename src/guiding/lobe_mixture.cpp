// SPDX-License-Identifier: Apache-2.0
#include "guiding/lobe_mixture.h"

#include <algorithm>

#include "core/prefetch.h"

namespace lampyris {

void LobeMixture::Side::take(const LobeSide& side, const LobeBlock* of) {
  static_cast<LobeSide&>(*this) = side;
  blocks = of;
  for (size_t i = 0; i < blocksOf(count); ++i) {
    prefetchLine(&blocks[i]);
    prefetchLine(&blocks[i].weight);
  }
}

void LobeMixture::Side::fill(const SignificanceCache::Lobes& cell, bool samePlane, const Vec3& p,
                             const Vec3& n, const DirectionWeight* scattering) {
  take({}, own.data());
  constexpr size_t kMost = SignificanceCache::kMostNearest;
  std::array<const SignificanceCache::Lobe*, kMost> above;
  std::array<Vec3, kMost> axes;
  std::array<float, kMost> tilts, scattered;
  size_t found = 0;
  for (const SignificanceCache::Lobe& r : cell.lobes) {
    const Vec3 axis = r.axis.at(p);
    const float tilt = n == Vec3(0) ? 1.f : std::min(dot(axis, n), 1.f);
    axes[found] = axis;
    tilts[found] = tilt;
    above[found] = &r;
    found += tilt > 0;
  }
  if (scattering)
    scattering->weigh({axes.data(), found}, {scattered.data(), found});
  else
    std::copy_n(tilts.begin(), found, scattered.begin());
  for (size_t i = 0; i < found; ++i) {
    const SignificanceCache::Lobe& r = *above[i];
    const float w = scattered[i] * r.flux;
    if (!(w > 0) || !std::isfinite(w)) continue;
    const bool isReady = samePlane && r.axis.turn == 0;
    add(own.data(), axes[i], r.level, w,
        isReady ? r.inverse : inverseClippedLobe(r.level, tilts[i]));
  }
}

bool LobeMixture::moveTo(const GuidePoint& point, const DirectionWeight& scattering) {
  n_ = point.n;
  const SignificanceCache::Lobes cell = cache_.find(point.p, point.n);
  const float even = scattering.even();
  lightWorth_ = cell.lightWorth;
  // Equal but for rounding: what the cell holds ready is right.
  const bool samePlane = lengthSquared(point.n - cell.n) < 1e-13f;
  static_cast<LobeSide&>(back_) = {};
  if (even >= 0) {
    if (samePlane && !cell.turn)
      front_.take(cell.even, cell.blocks);
    else
      front_.fill(cell, samePlane, point.p, point.n, nullptr);
    scattered_ = even * front_.total;
  } else {
    front_.fill(cell, samePlane, point.p, point.n, &scattering);
    if (point.onSurface() && point.transmits)
      back_.fill(cache_.find(point.p, -point.n), false, point.p, -point.n, &scattering);
    scattered_ = front_.total + back_.total;
  }
  share_ = 1 / (front_.total + back_.total);
  return scattered_ > 0 && std::isfinite(scattered_) && std::isfinite(share_);
}

Vec3 LobeMixture::sample(float u, const Vec2& v, NumberSequence& more) const {
  const float at = u * (front_.total + back_.total);
  if (back_.count == 0 || at < front_.total) return front_.sample(front_.blocks, at, n_, v, more);
  return back_.sample(back_.blocks, at - front_.total, -n_, v, more);
}

float LobeMixture::pdf(const Vec3& wi) const {
  const float side = n_ == Vec3(0) ? 1.f : dot(wi, n_);
  const double sum = side > 0   ? front_.sum(front_.blocks, wi)
                     : side < 0 ? back_.sum(back_.blocks, wi)
                                : 0.;
  return static_cast<float>(sum * static_cast<double>(share_));
}

}  // namespace lampyris
