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

 private:
  struct Lobe {
    Vec3 axis;
    Vec3 n;  ///< it counts where dot(w, n) > 0; zero: everywhere
    int level;
    float weight;         ///< share in the mixture
    float normalisation;  ///< weight / V
  };
  void add(const SignificanceCache::Lobes& cell, const Vec3& n, const DirectionWeight& scattering);

  const SignificanceCache& cache_;
  std::array<Lobe, 2 * SignificanceCache::kMostNearest> lobes_;  ///< of both sides of a surface
  size_t count_ = 0;
  float total_ = 0;
};

}  // namespace lampyris
