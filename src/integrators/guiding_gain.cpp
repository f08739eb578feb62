// SPDX-License-Identifier: Apache-2.0
#include "integrators/guiding_gain.h"

#include <cmath>

namespace lampyris {

namespace {

/// A guided path takes about this many times as long as another one.
constexpr double kTime = 1.25;
constexpr double kStandardErrors = 2;

}  // namespace

void GuidingGain::add(const Int2& pixel, const PairedRadiance& radiance) {
  if (pixel != pixel_) finish();
  pixel_ = pixel;
  const auto l = static_cast<double>(radiance.sum.luminance());
  samples_ += 1;
  sum_ += l;
  square_ += l * l;
  unguidedSquare_ += radiance.unguidedSquare;
}

void GuidingGain::finish() {
  if (samples_ > 1) {
    // Without bias: the mean of the products of different samples.
    const double meanSquare = (sum_ * sum_ - square_) / (samples_ - 1);
    const double guided = square_ - meanSquare, unguided = unguidedSquare_ - meanSquare;
    const double loss = kTime * guided - unguided;
    if (std::isfinite(loss * loss)) {
      guided_ += guided;
      unguided_ += unguided;
      loss_ += loss;
      lossSquare_ += loss * loss;
    }
  }
  samples_ = sum_ = square_ = unguidedSquare_ = 0;
}

void GuidingGain::fade() {
  for (double* sum : {&guided_, &unguided_, &loss_}) *sum *= 0.5;
  lossSquare_ *= 0.25;
}

void GuidingGain::operator+=(const GuidingGain& other) {
  guided_ += other.guided_;
  unguided_ += other.unguided_;
  loss_ += other.loss_;
  lossSquare_ += other.lossSquare_;
}

bool GuidingGain::pays() const { return !(loss_ > kStandardErrors * std::sqrt(lossSquare_)); }

}  // namespace lampyris
