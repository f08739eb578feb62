// SPDX-License-Identifier: Apache-2.0
/// What a film keeps of each pixel for its AOVs, and the image layers made of it.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "base/aov.h"
#include "core/image.h"
#include "film/pixel_sums.h"

namespace lampyris {

class AovSums {
 public:
  AovSums() = default;
  AovSums(AovSet set, size_t pixels);

  AovSet set() const { return set_; }
  /// Sums a pixel that a set takes.
  static size_t sumsPerPixel(AovSet set);

  /// Adds a path's record. Values that are not finite count as 0.
  void add(size_t pixel, const AovRecord& record);
  /// Adds a sample's colour, filter weight included, for the variance.
  void addColour(size_t pixel, const std::array<double, 3>& rgb);

  /// The layers of the set, values a pixel in the order of `pixels`: docs/aovs.md says what they
  /// are. `scale` is the film's factor on the pixels.
  std::vector<ImageLayer> layers(std::span<const PixelSums> pixels, double scale) const;

  std::span<WideSum> values() { return values_; }
  std::span<const WideSum> values() const { return values_; }

 private:
  WideSum* of(size_t pixel, Aov aov);
  const WideSum* of(size_t pixel, Aov aov) const;

  AovSet set_;
  size_t stride_ = 0;
  std::array<size_t, kAovNames.size()> offset_{};
  std::vector<WideSum> values_;
};

}  // namespace lampyris
