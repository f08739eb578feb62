// SPDX-License-Identifier: Apache-2.0
/// What the significance cache knows of one direction in the neighbourhood of one point.
#pragma once

#include "guiding/clipped_lobe.h"
#include "guiding/lobe_sums.h"
#include "guiding/turning_axis.h"

namespace lampyris {

/// A cosine lobe and the sums from which it is fitted. Names as in the paper (§3.2): position x̃,
/// direction ω̃, exponent e, counts Sa and Sr (S and the mean Ĩ are the same for all records of a
/// cell, see RecordCell).
///
/// The paper counts samples; here every sample counts with its weight w = L / pdf, the estimate of
/// the integral of radiance, because samples come from the very distribution that is learned: to
/// count them as they fall would confirm whatever was guessed first. With the weights, Sa sums what
/// belongs to the lobe and Sr the same times 1 − cos of the angle to the lobe's axis. A lobe of
/// exponent e has the mean cosine (e + 1) / (e + 2), so that the exponent that fits is
///
///     e = Sa / Sr − 2,
///
/// the form of eq. 9, right in expectation. Where directions turn with the place, as those to an
/// image in glass nearby, the axis turns likewise, and Sr counts what is left. A sample belongs to
/// several lobes in the shares in which they predict it (the E step of expectation maximisation),
/// in place of the thresholds of eq. 7 and 8.
class SignificanceRecord {
 public:
  SignificanceRecord() = default;
  /// A lobe made for one sample of weight `w`.
  SignificanceRecord(const Vec3& position, const Vec3& direction, double w);

  /// Counts a part of a sample's weight.
  void add(const Vec3& p, const Vec3& wi, double part);
  /// Fits the lobe to the sums; `samples` is the number of all samples nearby.
  void fit(double samples);
  void fade(double factor);
  /// As if there were so many times as much light.
  void brighten(double factor);
  /// Takes over what another record knows.
  void merge(const SignificanceRecord& other);

  /// Its place is the mean of the samples'.
  const TurningAxis& axis() const { return axis_; }
  int level() const { return level_; }
  /// e, in [1, kMaxLobeExponent].
  float exponent() const { return exponent_; }
  /// As many samples of equal weight would tell as much of the lobe.
  double effectiveSamples() const { return sums_.count(); }
  /// Integral of the lobe's radiance over directions.
  float flux() const { return flux_; }
  /// L̃: the lobe's peak.
  float radiance() const { return flux_ * inverseWholeLobe(level_); }

 private:
  glm::dvec3 anchor_{0};  ///< of the sums: where the first sample was
  TurningAxis axis_;
  float exponent_ = 1, flux_ = 0;
  int level_ = 0;
  LobeSums sums_;
};

}  // namespace lampyris
