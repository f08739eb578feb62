// SPDX-License-Identifier: Apache-2.0
/// The sums from which a lobe is fitted.
#pragma once

#include "core/vector.h"

namespace lampyris {

/// Of weighted directions w ωᵢ, each found at a place xᵢ, which is told from some anchor.
struct LobeSums {
  double weight = 0, weight2 = 0;  ///< Σ w (the paper's Sa), Σ w²
  glm::dvec3 direction{0};         ///< Σ w ω
  glm::dvec3 place{0};             ///< Σ w x
  glm::dmat3 places{0};            ///< Σ w x xᵀ
  double both = 0;                 ///< Σ w x·ω

  void add(const glm::dvec3& x, const Vec3& wi, double w);
  /// Of an anchor that lies `shift` beyond this one's.
  void add(const LobeSums& other, const glm::dvec3& shift);
  void scale(double factor);
  /// As if all weights had been so many times as large.
  void brighten(double factor);

  /// How many directions of equal weight would tell as much; needs weight > 0.
  double count() const { return weight * weight / weight2; }
  /// Sr: the sum of w (1 − cos) around the mean direction.
  double spread() const;

  /// How the directions turn with the place: the turn κ (see TurningAxis) that least squares of
  /// ω(x) = ω̄ − κ (x − x̄) give, across `axis`; and what Sr loses by it. Both 0 where it cannot be
  /// told.
  struct Turn {
    double turn = 0, gain = 0;
  };
  Turn fitTurn(const glm::dvec3& axis) const;
};

}  // namespace lampyris
