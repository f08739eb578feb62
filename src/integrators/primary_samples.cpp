// SPDX-License-Identifier: Apache-2.0
#include "integrators/primary_samples.h"

#include <algorithm>
#include <cassert>

#include "core/hash.h"
#include "core/sampling.h"

namespace lampyris {

namespace {

/// A standard normal variate of 64 random bits (Box and Muller 1958).
float normalOf(uint64_t bits) {
  const float u = 1 - toUnitFloat(bits);  // in (0, 1]
  return std::sqrt(-2 * std::log(u)) * circlePoint(toUnitFloat(static_cast<uint32_t>(bits))).x;
}

float wrapped(float x) { return std::min(x - std::floor(x), kOneMinusEpsilon); }

}  // namespace

void PrimarySamples::propose(uint64_t seed, float sigma) {
  seed_ = seed;
  sigma_ = sigma;
  proposedSteady_ = sigma == 0 ? seed : currentSteady_;
  std::fill(proposed_.begin(), proposed_.end(), kUnknown);
}

float PrimarySamples::get1D(const SampleAddress&, uint32_t dimension) const {
  assert(dimension < proposed_.size());
  float& x = proposed_[dimension];
  if (x != kUnknown) return x;
  const uint64_t bits = hashCombine(seed_, dimension);
  const float before = current_[dimension];
  const bool fresh = sigma_ == 0 || before == kUnknown;
  return x = fresh ? toUnitFloat(bits) : wrapped(before + sigma_ * normalOf(bits));
}

Vec2 PrimarySamples::get2D(const SampleAddress& address, uint32_t dimension) const {
  const float x = get1D(address, dimension);
  return {x, get1D(address, dimension + 1)};
}

}  // namespace lampyris
