// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "guiding/significance_cache.h"

namespace lampyris {

/// The lobes around a point, weighed by what the point scatters of them (eq. 4) and clipped by its
/// tangent plane (eq. 6, without the BSDF's term).
class LobeMixture final : public LocalGuide {
 public:
  explicit LobeMixture(const SignificanceCache& cache) : cache_(cache) {}

  bool moveTo(const GuidePoint& point, const DirectionWeight& scattering) override;
  Vec3 sample(float u, const Vec2& v, NumberSequence& more) const override;
  float pdf(const Vec3& wi) const override;
  float scattered() const override { return scattered_; }
  float lightWorth() const override { return lightWorth_; }

 private:
  /// Lobes on one side of a surface, or of a medium.
  struct Side : LobeSide {
    const LobeBlock* blocks = nullptr;
    std::array<LobeBlock, SignificanceCache::kMostNearest / LobeBlock::kLanes> own;

    /// Of those that the cell holds ready.
    void take(const LobeSide& side, const LobeBlock* of);
    /// Those that count at `p` above a plane with normal `n` (zero: everywhere). `scattering` null:
    /// that of a diffuse surface.
    void fill(const SignificanceCache::Lobes& cell, bool samePlane, const Vec3& p, const Vec3& n,
              const DirectionWeight* scattering);
  };

  const SignificanceCache& cache_;
  Vec3 n_{0};
  float scattered_ = 0, lightWorth_ = 1;
  float share_ = 0;    ///< of a lobe in the mixture, over its weight
  Side front_, back_;  ///< back_: of what is transmitted
};

}  // namespace lampyris
