// SPDX-License-Identifier: Apache-2.0
/// Samples whose radiance is no radiance: how many of which kind, and the first of them.
#pragma once

#include <vector>

#include "base/sampler.h"
#include "core/rgb.h"
#include "core/statistics.h"

namespace lampyris {

class BadSamples {
 public:
  void add(const SampleAddress& address, const Rgb& radiance);
  bool empty() const { return nan_ + infinite_ + negative_ == 0; }
  /// The result does not depend on the order of merges.
  void merge(const BadSamples& other);
  void report(Statistics& statistics) const;

 private:
  uint64_t nan_ = 0, infinite_ = 0, negative_ = 0;
  std::vector<SampleAddress> first_;
};

}  // namespace lampyris
