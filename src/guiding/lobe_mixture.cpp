// SPDX-License-Identifier: Apache-2.0
#include "guiding/lobe_mixture.h"

#include <algorithm>
#include <experimental/simd>

namespace lampyris {

namespace {

namespace stdx = std::experimental;
constexpr size_t kLanes = 4;
using Floats = stdx::simd<float, stdx::simd_abi::deduce_t<float, kLanes>>;
using Doubles = stdx::rebind_simd_t<double, Floats>;

Floats floats(const float* from) { return Floats(from, stdx::element_aligned); }
Doubles doubles(const float* from) { return stdx::static_simd_cast<Doubles>(floats(from)); }

}  // namespace

bool LobeMixture::moveTo(const GuidePoint& point, const DirectionWeight& scattering) {
  n_ = point.n;
  front_.fill(cache_.find(point.p, point.n), point.n, scattering);
  const bool transmits = point.onSurface() && point.transmits;
  back_.fill(transmits ? cache_.find(point.p, -point.n) : SignificanceCache::Lobes(), -point.n,
             scattering);
  share_ = 1 / scattered();
  return scattered() > 0 && std::isfinite(share_);
}

/// Takes the lobes that count above a plane with normal `n` (zero: everywhere).
void LobeMixture::Side::fill(const SignificanceCache::Lobes& cell, const Vec3& n,
                             const DirectionWeight& at) {
  total = 0;
  count = 0;
  mostSquarings = 0;
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
    factors[count] = static_cast<float>(lobeFactors(r.level));
    squarings[count] = static_cast<float>(lobeSquarings(r.level));
    mostSquarings = std::max(mostSquarings, lobeSquarings(r.level));
    weight[count] = w;
    normalisation[count] = w * (samePlane ? r.inverse : inverseClippedLobe(r.level, tilt));
    ++count;
  }
  for (size_t i = count; i % kLanes != 0; ++i)
    x[i] = y[i] = z[i] = normalisation[i] = factors[i] = squarings[i] = 0;
}

/// As a sum over lobePower(), a few lobes at a time.
double LobeMixture::Side::sum(const Vec3& wi) const {
  Doubles sum = 0;
  for (size_t i = 0; i < count; i += kLanes) {
    const Floats dx = wi.x - floats(&x[i]), dy = wi.y - floats(&y[i]), dz = wi.z - floats(&z[i]);
    const Doubles chord2 = stdx::static_simd_cast<Doubles>(dx * dx + dy * dy + dz * dz);
    Doubles c = 1 - 0.5 * chord2;
    stdx::where(c < 0, c) = 0;
    const Doubles first = doubles(&factors[i]), left = doubles(&squarings[i]);
    Doubles power = c;
    stdx::where(first > 1.5, power) *= c;
    stdx::where(first > 2.5, power) *= c;
    for (int done = 0; done < mostSquarings; ++done)
      stdx::where(left > static_cast<double>(done), power) *= Doubles(power);
    sum += doubles(&normalisation[i]) * power;
  }
  return stdx::reduce(sum);
}

Vec3 LobeMixture::sample(float u, const Vec2& v, NumberSequence& more) const {
  float left = u * scattered();
  const auto drawn = [&](const Side& side, const Vec3& n) {
    size_t i = 0;
    for (; i + 1 < side.count && left >= side.weight[i]; ++i) left -= side.weight[i];
    return n == Vec3(0) ? sampleLobe(side.level[i], side.axis(i), v)
                        : sampleClippedLobe(side.level[i], side.axis(i), n, v, more);
  };
  if (back_.count == 0 || left < front_.total) return drawn(front_, n_);
  left -= front_.total;
  return drawn(back_, -n_);
}

float LobeMixture::pdf(const Vec3& wi) const {
  const float side = n_ == Vec3(0) ? 1.f : dot(wi, n_);
  const double sum = side > 0 ? front_.sum(wi) : side < 0 ? back_.sum(wi) : 0.;
  return static_cast<float>(sum * static_cast<double>(share_));
}

}  // namespace lampyris
