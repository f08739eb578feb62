// SPDX-License-Identifier: Apache-2.0
/// Cosine lobes with weights, clipped by one plane: what directions are drawn from (eq. 4 and 6 of
/// Bashford-Rogers et al. 2012, without the BSDF's term).
#pragma once

#include <array>

#include "guiding/clipped_lobe.h"

namespace lampyris {

/// Four lobes by parts, so that sums over lobes use vector instructions. What stands behind the
/// last lobe has no weight.
struct alignas(64) LobeBlock {
  static constexpr size_t kLanes = 4;
  template <class T>
  using Lanes = std::array<T, kLanes>;

  Lanes<float> x{}, y{}, z{};           ///< axes
  Lanes<float> factors{}, squarings{};  ///< of the power, see lobePower()
  Lanes<float> weight{};
  Lanes<float> normalisation{};  ///< weight / V
  Lanes<int32_t> level{};
};
static_assert(sizeof(LobeBlock) == 128);

/// The lobes above a plane, or of a medium; they lie elsewhere.
struct LobeSide {
  float total = 0;  ///< sum of the weights
  uint16_t count = 0, mostSquarings = 0;

  static size_t blocksOf(size_t lobes) {
    return (lobes + LobeBlock::kLanes - 1) / LobeBlock::kLanes;
  }
  /// Of block count / kLanes, which is cleared with its first lobe. `inverse`: 1 / V.
  void add(LobeBlock* blocks, const Vec3& axis, int level, float weight, float inverse);
  /// Of the lobes' densities, by weight.
  double sum(const LobeBlock* blocks, const Vec3& wi) const;
  /// Draws a lobe in proportion to its weight, `at` in [0, total), and a direction of it. `n` zero:
  /// there is no plane.
  Vec3 sample(const LobeBlock* blocks, float at, const Vec3& n, const Vec2& v,
              NumberSequence& more) const;
};

}  // namespace lampyris
