// SPDX-License-Identifier: Apache-2.0
#include "guiding/lobe_sums.h"

#include <algorithm>

namespace lampyris {

void LobeSums::add(const glm::dvec3& x, const Vec3& wi, double w) {
  const glm::dvec3 omega(wi);
  weight += w;
  weight2 += w * w;
  direction += w * omega;
  place += w * x;
  places += w * glm::outerProduct(x, x);
  both += w * glm::dot(x, omega);
}

void LobeSums::add(const LobeSums& other, const glm::dvec3& shift) {
  const glm::dmat3 mixed = glm::outerProduct(shift, other.place);
  weight += other.weight;
  weight2 += other.weight2;
  direction += other.direction;
  places +=
      other.places + mixed + glm::transpose(mixed) + other.weight * glm::outerProduct(shift, shift);
  place += other.place + other.weight * shift;
  both += other.both + glm::dot(shift, other.direction);
}

void LobeSums::scale(double factor) {
  weight *= factor;
  weight2 *= factor;
  direction *= factor;
  place *= factor;
  places *= factor;
  both *= factor;
}

void LobeSums::brighten(double factor) {
  scale(factor);
  weight2 *= factor;
}

double LobeSums::spread() const { return std::max(0., weight - glm::length(direction)); }

LobeSums::Turn LobeSums::fitTurn(const glm::dvec3& axis) const {
  // Covariances. Directions vary across the axis only, so only there do places tell anything.
  const glm::dvec3 mean = place / weight;
  const glm::dmat3 cov = places / weight - glm::outerProduct(mean, mean);
  const double all = cov[0][0] + cov[1][1] + cov[2][2];
  const double across = all - glm::dot(axis, cov * axis);
  const double cross = (both - glm::dot(mean, direction)) / weight;
  constexpr double kRounding = 1e-12;
  if (!(across > kRounding * (all + glm::dot(mean, mean)))) return {};
  // The slope is taken to be a little less, as one direction against it would make it.
  const double share = 1 - 1 / count();
  const Turn found{-share * cross / across,
                   0.5 * weight * share * (2 - share) * cross * cross / across};
  return std::isfinite(found.turn) && std::isfinite(found.gain) ? found : Turn{};
}

}  // namespace lampyris
