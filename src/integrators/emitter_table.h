// SPDX-License-Identifier: Apache-2.0
/// Which light a path from the lights starts at.
#pragma once

#include "base/light_distribution.h"
#include "lightdistributions/alias_table.h"

namespace lampyris {

/// Draws lights by power: nothing is known yet of where their paths lead.
class EmitterTable {
 public:
  explicit EmitterTable(const LightTable& lights);

  /// True if no light emits.
  bool empty() const { return table_.empty(); }
  /// `u` in [0, 1). Not to be called if empty.
  SampledLight sample(float u) const;
  float pmf(LightId light) const { return table_.pmf(light); }

 private:
  AliasTable table_;
};

}  // namespace lampyris
