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
  float scattered() const override { return front_.total + back_.total; }

 private:
  /// Lobes on one side of a surface, or of a medium, by parts: loops over lobes use vector
  /// instructions.
  struct Side {
    static constexpr size_t kMost = SignificanceCache::kMostNearest;

    float total = 0;  ///< sum of the weights
    size_t count = 0;
    int mostSquarings = 0;
    // Loops run over whole vectors; what stands behind the last lobe has no weight.
    alignas(64) std::array<float, kMost> x, y, z;
    std::array<float, kMost> factors, squarings;     ///< of the power, see lobePower()
    std::array<float, kMost> weight, normalisation;  ///< eq. 4; the same / V
    std::array<int32_t, kMost> level;

    void fill(const SignificanceCache::Lobes& cell, const Vec3& n, const DirectionWeight& at);
    /// Of the lobes' densities, by weight.
    double sum(const Vec3& wi) const;
    Vec3 axis(size_t i) const { return {x[i], y[i], z[i]}; }
  };

  const SignificanceCache& cache_;
  Vec3 n_{0};
  float share_ = 0;    ///< of a lobe in the mixture, over its weight
  Side front_, back_;  ///< back_: of what is transmitted
};

}  // namespace lampyris
