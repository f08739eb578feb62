// SPDX-License-Identifier: Apache-2.0
#include "guiding/significance_record.h"

#include <cmath>

namespace lampyris {

namespace {

/// A new lobe is 33° wide (to half its height), so that few cover a hemisphere, and narrows as
/// samples tell.
constexpr float kFirstExponent = 4;
/// A fit counts the first guess like this many samples of equal weight.
constexpr double kPrior = 0.2;
/// An axis turns where more samples than this tell so, and only if Sr falls below this part.
constexpr double kLeastToTurn = 3, kWorthATurn = 0.9;
constexpr double kLargestFlux = 1e30;

}  // namespace

SignificanceRecord::SignificanceRecord(const Vec3& position, const Vec3& direction, double w)
    : anchor_(position),
      axis_{direction, position, 0},
      exponent_(kFirstExponent),
      level_(lobeLevel(kFirstExponent)) {
  add(position, direction, w);
}

void SignificanceRecord::add(const Vec3& p, const Vec3& wi, double part) {
  sums_.add(glm::dvec3(p) - anchor_, wi, part);
}

void SignificanceRecord::fit(double samples) {
  if (!(sums_.weight > 0) || !(samples > 0)) {
    flux_ = 0;
    return;
  }
  flux_ = static_cast<float>(std::min(sums_.weight / samples, kLargestFlux));
  const double moment = glm::length(sums_.direction);
  if (!(moment > 0)) return;
  const glm::dvec3 mean = sums_.direction / moment;
  axis_ = {normalize(Vec3(mean)), Vec3(anchor_ + sums_.place / sums_.weight), 0};
  // Around their own mean n samples spread by n − 1 parts of n only, around a turning one by n − 2.
  const double n = sums_.count();
  double sr = sums_.spread() * n / std::max(n - 1, 0.1);
  if (n > kLeastToTurn) {
    const LobeSums::Turn t = sums_.fitTurn(mean);
    const double turned = std::max(0., sums_.spread() - t.gain) * n / (n - 2);
    if (turned < kWorthATurn * sr) {
      sr = turned;
      axis_.turn = static_cast<float>(t.turn);
    }
  }
  const double guess = kPrior * sums_.weight / n;
  const double guessSr = guess / (static_cast<double>(kFirstExponent) + 2);
  const double e = (sums_.weight + guess) / (sr + guessSr) - 2;
  exponent_ = std::clamp(static_cast<float>(e), 1.f, kMaxLobeExponent);
  level_ = lobeLevel(exponent_);
}

void SignificanceRecord::fade(double factor) { sums_.scale(factor); }

void SignificanceRecord::brighten(double factor) {
  sums_.brighten(factor);
  flux_ = static_cast<float>(static_cast<double>(flux_) * factor);
}

void SignificanceRecord::merge(const SignificanceRecord& other) {
  sums_.add(other.sums_, other.anchor_ - anchor_);
  flux_ += other.flux_;
}

}  // namespace lampyris
