// SPDX-License-Identifier: Apache-2.0
/// The random numbers of one path as a point that moves: primary sample space (Kelemen et al. 2002,
/// "A Simple and Robust Mutation Strategy for the Metropolis Light Transport Algorithm").
#pragma once

#include <vector>

#include "base/sampler.h"

namespace lampyris {

/// A current point of the unit cube and a proposal for the next one, which exists as far as it is
/// asked for. Numbers that the current path did not ask for are forgotten, which leaves every
/// density as it is: nothing depends on them, so given the others they are uniform. For one thread.
class PrimarySamples final : public Sampler {
 public:
  /// Numbers have a dimension < `dimensions`. There is no current point yet.
  explicit PrimarySamples(size_t dimensions)
      : current_(dimensions, kUnknown), proposed_(dimensions, kUnknown) {}

  /// The next proposal, a function of the current point and `seed`. Independent of that point:
  void proposeAnew(uint64_t seed) { propose(seed, 0); }
  /// Near it: every number moves by a normal variate of the standard deviation `sigma` > 0, over
  /// the ends of [0, 1).
  void proposeNear(uint64_t seed, float sigma) { propose(seed, sigma); }
  /// Makes the proposal the current point.
  void accept() {
    current_.swap(proposed_);
    currentSteady_ = proposedSteady_;
  }

  /// Of the proposal. The address counts for nothing.
  float get1D(const SampleAddress& address, uint32_t dimension) const override;
  Vec2 get2D(const SampleAddress& address, uint32_t dimension) const override;
  int samplesPerPixel() const override { return 1; }
  /// A coordinate of the proposal that small steps leave alone: a seed for what has no dimension.
  uint64_t steadySeed() const { return proposedSteady_; }

 private:
  static constexpr float kUnknown = -1;
  void propose(uint64_t seed, float sigma);

  std::vector<float> current_;
  mutable std::vector<float> proposed_;  ///< filled as it is asked for
  uint64_t currentSteady_ = 0, proposedSteady_ = 0;
  uint64_t seed_ = 0;
  float sigma_ = 0;  ///< 0: independent of the current point
};

}  // namespace lampyris
