// SPDX-License-Identifier: Apache-2.0
#include "guiding/lobe_side.h"

#include <algorithm>
#include <experimental/simd>

namespace lampyris {

namespace {

constexpr size_t kLanes = LobeBlock::kLanes;
namespace stdx = std::experimental;
using Floats = stdx::simd<float, stdx::simd_abi::deduce_t<float, kLanes>>;
using Doubles = stdx::rebind_simd_t<double, Floats>;

Floats floats(const LobeBlock::Lanes<float>& from) {
  return Floats(from.data(), stdx::element_aligned);
}
Doubles doubles(const LobeBlock::Lanes<float>& from) {
  return stdx::static_simd_cast<Doubles>(floats(from));
}

}  // namespace

void LobeSide::add(LobeBlock* blocks, const Vec3& axis, int lobeLevel, float weight,
                   float inverse) {
  LobeBlock& b = blocks[count / kLanes];
  const size_t lane = count++ % kLanes;
  if (lane == 0) b = {};
  b.x[lane] = axis.x, b.y[lane] = axis.y, b.z[lane] = axis.z;
  b.level[lane] = lobeLevel;
  b.factors[lane] = static_cast<float>(lobeFactors(lobeLevel));
  b.squarings[lane] = static_cast<float>(lobeSquarings(lobeLevel));
  b.weight[lane] = weight;
  b.normalisation[lane] = weight * inverse;
  total += weight;
  mostSquarings = std::max(mostSquarings, static_cast<uint16_t>(lobeSquarings(lobeLevel)));
}

/// As a sum over lobePower(), a few lobes at a time.
double LobeSide::sum(const LobeBlock* blocks, const Vec3& wi) const {
  Doubles sum = 0;
  for (const LobeBlock* b = blocks; b < blocks + blocksOf(count); ++b) {
    const Floats dx = wi.x - floats(b->x), dy = wi.y - floats(b->y), dz = wi.z - floats(b->z);
    const Doubles chord2 = stdx::static_simd_cast<Doubles>(dx * dx + dy * dy + dz * dz);
    Doubles c = 1 - 0.5 * chord2;
    stdx::where(c < 0, c) = 0;
    const Doubles first = doubles(b->factors), left = doubles(b->squarings);
    Doubles power = c;
    stdx::where(first > 1.5, power) *= c;
    stdx::where(first > 2.5, power) *= c;
    for (int done = 0; done < mostSquarings; ++done)
      stdx::where(left > static_cast<double>(done), power) *= Doubles(power);
    sum += doubles(b->normalisation) * power;
  }
  return stdx::reduce(sum);
}

Vec3 LobeSide::sample(const LobeBlock* blocks, float at, const Vec3& n, const Vec2& v,
                      NumberSequence& more) const {
  size_t i = 0;
  for (; i + 1u < count && at >= blocks[i / kLanes].weight[i % kLanes]; ++i)
    at -= blocks[i / kLanes].weight[i % kLanes];
  const LobeBlock& b = blocks[i / kLanes];
  const size_t lane = i % kLanes;
  const Vec3 axis(b.x[lane], b.y[lane], b.z[lane]);
  return n == Vec3(0) ? sampleLobe(b.level[lane], axis, v)
                      : sampleClippedLobe(b.level[lane], axis, n, v, more);
}

}  // namespace lampyris
