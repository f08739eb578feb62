// SPDX-License-Identifier: Apache-2.0
/// Reconstruction filters, used by filter importance sampling: a sample falls into one pixel.
#pragma once

#include "core/registry.h"
#include "core/vector.h"

namespace lampyris {

/// An offset from a pixel's centre and the weight of a sample there. The mean weight is 1, so a
/// pixel is the mean of weight × radiance.
struct FilterSample {
  Vec2 offset{0};
  float weight = 1;
};

class Filter {
 public:
  virtual ~Filter() = default;
  /// Half the width, in pixels: the filter is 0 beyond.
  virtual Vec2 radius() const = 0;
  virtual float evaluate(const Vec2& offset) const = 0;
  /// Draws an offset in proportion to |evaluate|, as far as its table goes; the weight makes it
  /// exact.
  virtual FilterSample sample(const Vec2& u) const = 0;
};

struct FilterContext {};
using FilterRegistry = Registry<Filter, FilterContext>;

}  // namespace lampyris
