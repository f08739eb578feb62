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
constexpr double kLargestFlux = 1e30;

}  // namespace

SignificanceRecord::SignificanceRecord(const Vec3& position, const Vec3& direction, double w)
    : position_(position),
      direction_(direction),
      exponent_(kFirstExponent),
      level_(lobeLevel(kFirstExponent)) {
  add(direction, w);
}

void SignificanceRecord::add(const Vec3& wi, double part) {
  sa_ += part;
  sa2_ += part * part;
  for (int k = 0; k < 3; ++k) m_[k] += part * static_cast<double>(wi[k]);
}

void SignificanceRecord::fit(double samples) {
  if (!(sa_ > 0) || !(samples > 0)) {
    flux_ = 0;
    return;
  }
  flux_ = static_cast<float>(std::min(sa_ / samples, kLargestFlux));
  const double moment = std::sqrt(m_[0] * m_[0] + m_[1] * m_[1] + m_[2] * m_[2]);
  if (!(moment > 0)) return;
  for (int k = 0; k < 3; ++k) direction_[k] = static_cast<float>(m_[k] / moment);
  direction_ = normalize(direction_);
  // Around their own mean n samples spread by n − 1 parts of n only; n counts unequal weights as
  // one does for variances.
  const double n = sa_ * sa_ / sa2_;
  const double sr = std::max(0., sa_ - moment) * n / std::max(n - 1, 0.1);
  const double guess = kPrior * sa_ / n;
  const double guessSr = guess / (static_cast<double>(kFirstExponent) + 2);
  const double e = (sa_ + guess) / (sr + guessSr) - 2;
  exponent_ = std::clamp(static_cast<float>(e), 1.f, kMaxLobeExponent);
  level_ = lobeLevel(exponent_);
}

void SignificanceRecord::fade(double factor) {
  sa_ *= factor;
  sa2_ *= factor;
  for (double& m : m_) m *= factor;
}

void SignificanceRecord::merge(const SignificanceRecord& other) {
  sa_ += other.sa_;
  sa2_ += other.sa2_;
  for (int k = 0; k < 3; ++k) m_[k] += other.m_[k];
  flux_ += other.flux_;
}

}  // namespace lampyris
