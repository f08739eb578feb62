// SPDX-License-Identifier: Apache-2.0
/// Whether guiding pays: the variance of guided paths, and the variance that the same estimator
/// would have without a guide, both estimated from the same guided paths.
///
/// A way that is drawn with density p, and without a guide would be drawn with density q, and that
/// contributes f, has the estimate C = f/p. Without a guide the second moment is ∫ f²/q =
/// E[C² p/q]: each sample tells its share of both. As both are of the same samples, their ratio is
/// known well long before either is.
#pragma once

#include "core/spectrum.h"
#include "core/vector.h"

namespace lampyris {

/// The radiance of a guided path, term by term, with its square as it counts without a guide.
struct PairedRadiance {
  Rgb sum{};
  double unguidedSum = 0, unguidedSquare = 0;

  /// Adds a term. `odds`: p/q of the way to it, over the choices of directions and of whether to go
  /// on. It is there with the probability `chance` (without a guide always).
  void add(const Rgb& term, double odds, float chance = 1) {
    const auto added = static_cast<double>(term.luminance());
    // With the density q of the longer of two ways, their product stands for 1/q of the shorter.
    unguidedSquare += added * (added * odds * static_cast<double>(chance) + 2 * unguidedSum);
    unguidedSum += added * odds;
    sum += term;
  }
};

/// Collects samples pixel by pixel.
class GuidingGain {
 public:
  /// Counts a sample. Those of a pixel must come one after the other.
  void add(const Int2& pixel, const PairedRadiance& radiance);
  /// Ends the last pixel.
  void finish();
  /// What has been collected counts half from now on.
  void fade();
  /// Adds what others have collected; they must be finished.
  void operator+=(const GuidingGain& other);
  /// False once it is clear, to two standard errors, that the variance is not lower by so much
  /// that it is worth the time.
  bool pays() const;
  /// Variance with the guide over that without; NaN where nothing is known.
  double varianceRatio() const { return guided_ / unguided_; }

 private:
  Int2 pixel_{0};
  double samples_ = 0, sum_ = 0, square_ = 0, unguidedSquare_ = 0;  ///< of the pixel
  double guided_ = 0, unguided_ = 0;  ///< sums of variances × samples
  double loss_ = 0, lossSquare_ = 0;  ///< sums over pixels of what guiding costs, and its square
};

}  // namespace lampyris
