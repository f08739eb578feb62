// SPDX-License-Identifier: Apache-2.0
#include "guiding/lobe_mixture.h"

#include <algorithm>

namespace lampyris {

bool LobeMixture::moveTo(const GuidePoint& point, const DirectionWeight& scattering) {
  n_ = point.n;
  front_.fill(cache_.find(point.p, point.n), point.n, scattering);
  const bool transmits = point.onSurface() && point.transmits;
  back_.fill(transmits ? cache_.find(point.p, -point.n) : SignificanceCache::Lobes(), -point.n,
             scattering);
  const float total = front_.total + back_.total;
  if (!(total > 0) || !std::isfinite(1 / total)) return false;
  front_.scale(1 / total);
  back_.scale(1 / total);
  return true;
}

/// Takes the lobes that count above a plane with normal `n` (zero: everywhere).
void LobeMixture::Side::fill(const SignificanceCache::Lobes& cell, const Vec3& n,
                             const DirectionWeight& at) {
  total = 0;
  count = 0;
  squarings = 0;
  // Equal but for rounding: V is known.
  const bool samePlane = lengthSquared(n - cell.n) < 1e-13f;
  for (const SignificanceCache::Lobe& r : cell.lobes) {
    const float tilt = n == Vec3(0) ? 1.f : dot(r.axis, n);
    if (!(tilt > 0)) continue;
    const float w = at.weight(r.axis) * r.flux;
    if (!(w > 0) || !std::isfinite(w)) continue;
    total += w;
    x[count] = r.axis.x, y[count] = r.axis.y, z[count] = r.axis.z;
    level[count] = r.level;
    squarings = std::max(squarings, lobeSquarings(r.level));
    weight[count] = w;
    normalisation[count] = w * (samePlane ? r.inverse : inverseClippedLobe(r.level, tilt));
    ++count;
  }
  for (size_t i = count; i % kLanes != 0; ++i) {
    x[i] = y[i] = z[i] = normalisation[i] = 0;
    level[i] = 0;
  }
}

void LobeMixture::Side::scale(float factor) {
  for (size_t i = 0; i < count; ++i) {
    weight[i] *= factor;
    normalisation[i] *= factor;
  }
}

/// As a sum over lobePower(), a few lobes at a time.
float LobeMixture::Side::pdf(const Vec3& wi) const {
  std::array<double, kLanes> sum{};
  for (size_t first = 0; first < count; first += kLanes) {
    std::array<double, kLanes> power;
    std::array<int32_t, kLanes> left;
    for (size_t k = 0; k < kLanes; ++k) {
      const size_t i = first + k;
      const float dx = wi.x - x[i], dy = wi.y - y[i], dz = wi.z - z[i];
      const double c = std::max(0., 1 - 0.5 * static_cast<double>(dx * dx + dy * dy + dz * dz));
      const double square = c * c;
      left[k] = lobeSquarings(level[i]);
      power[k] = level[i] == 0 ? c : level[i] % 2 ? square : square * c;
    }
    for (int done = 0; done < squarings; ++done)
      for (size_t k = 0; k < kLanes; ++k) power[k] *= done < left[k] ? power[k] : 1;
    for (size_t k = 0; k < kLanes; ++k)
      sum[k] += static_cast<double>(normalisation[first + k]) * power[k];
  }
  double all = 0;
  for (const double s : sum) all += s;
  return static_cast<float>(all);
}

Vec3 LobeMixture::sample(float u, const Vec2& v, NumberSequence& more) const {
  float left = u;
  const auto drawn = [&](const Side& side, const Vec3& n) {
    size_t i = 0;
    for (; i + 1 < side.count && left >= side.weight[i]; ++i) left -= side.weight[i];
    return n == Vec3(0) ? sampleLobe(side.level[i], side.axis(i), v)
                        : sampleClippedLobe(side.level[i], side.axis(i), n, v, more);
  };
  float front = 0;
  for (size_t i = 0; i < front_.count; ++i) front += front_.weight[i];
  if (back_.count == 0 || left < front) return drawn(front_, n_);
  left -= front;
  return drawn(back_, -n_);
}

float LobeMixture::pdf(const Vec3& wi) const {
  if (n_ == Vec3(0)) return front_.pdf(wi);
  const float side = dot(wi, n_);
  return side > 0 ? front_.pdf(wi) : side < 0 ? back_.pdf(wi) : 0.f;
}

}  // namespace lampyris
