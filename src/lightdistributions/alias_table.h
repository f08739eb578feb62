// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace lampyris {

/// Draws an index by weight in constant time (Vose 1991).
class AliasTable {
 public:
  AliasTable() = default;
  /// Weights that are ≤ 0 or not finite count as 0: such an index is never drawn. Fewer than 2³².
  explicit AliasTable(std::span<const double> weights);

  /// True if there is nothing to draw.
  bool empty() const { return bins_.empty(); }
  /// `u` in [0, 1), of double precision. Not to be called if empty.
  uint32_t sample(double u) const;
  /// 0 for an index out of range.
  float pmf(uint32_t index) const { return index < bins_.size() ? bins_[index].pmf : 0; }

 private:
  struct Bin {
    float keep = 1;  ///< probability of the bin's own index; else the alias
    uint32_t alias = 0;
    float pmf = 0;
  };
  std::vector<Bin> bins_;
};

}  // namespace lampyris
