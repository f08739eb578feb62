// SPDX-License-Identifier: Apache-2.0
/// The records of one neighbourhood, learned together.
#pragma once

#include <vector>

#include "core/bytes.h"
#include "guiding/guide.h"
#include "guiding/significance_record.h"

namespace lampyris {

/// A mixture of lobes, fitted by stepwise expectation maximisation: the lobes are fitted anew
/// whenever the number of samples has doubled, and what was counted before then counts half, so
/// that early guesses are forgotten; unless they are known to be good.
class RecordCell {
 public:
  /// In all, whatever their room.
  static constexpr size_t kMostRecords = 32;

  /// `room`: how many records it may hold; twice as many where they are narrow.
  explicit RecordCell(int room);
  /// A part of `parent`, from whose records it starts as if it had counted `share` of the samples.
  /// `brightness`: of what is to come there, in relation to the parent's.
  RecordCell(const RecordCell& parent, double share, double brightness = 1);

  /// From now on counts all samples the same, early ones as well.
  void forgetNothing() { fading_ = 1; }
  /// Counts a sample. True if it made a record; `mayInsert` false: it must not.
  bool learn(const GuideSample& sample, bool mayInsert);
  /// Fits, and drops what does not help.
  void endPass();

  const std::vector<SignificanceRecord>& records() const { return records_; }
  /// How many samples of equal weight would tell as much of the radiance.
  double effectiveSamples() const { return i2_ > 0 ? i_ / i2_ * i_ : 0; }
  /// Of the surface that the latest sample was on; zero in a medium.
  const Vec3& normal() const { return normal_; }
  /// Ĩ times 2π: mean weight of all samples, the flux of all directions.
  double meanFlux() const { return s_ > 0 ? i_ / s_ : 0; }
  /// In (0, 1]: the part of light samples that is worth taking, four for one that finds light.
  double lightWorth() const;

  void save(ByteWriter& out) const;
  void restore(ByteReader& in);

 private:
  /// What was counted counts so much less.
  void fade(double factor);
  void fit();
  bool hasRoom() const;
  void mergeAlike();

  int room_;
  double fading_;
  std::vector<SignificanceRecord> records_;
  Vec3 normal_{0};
  double s_ = 0, i_ = 0, i2_ = 0;  ///< S, sums of weights and of their squares
  double lightTried_ = 0, lightFound_ = 0;
  double sinceFit_ = 0, nextFit_;
};

}  // namespace lampyris
