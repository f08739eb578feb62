// SPDX-License-Identifier: Apache-2.0
#include "lightdistributions/alias_table.h"

#include <algorithm>
#include <cmath>

namespace lampyris {

AliasTable::AliasTable(std::span<const double> weights) {
  const size_t n = weights.size();
  std::vector<double> scaled(n);  // by n / total: 1 is a bin's fill
  double total = 0;
  uint32_t heaviest = 0;
  for (size_t i = 0; i < n; ++i) {
    scaled[i] = weights[i] > 0 && std::isfinite(weights[i]) ? weights[i] : 0;
    total += scaled[i];
    if (scaled[i] > scaled[heaviest]) heaviest = static_cast<uint32_t>(i);
  }
  if (!(total > 0) || !std::isfinite(total)) return;
  bins_.resize(n);
  std::vector<uint32_t> small, large;
  for (uint32_t i = 0; i < n; ++i) {
    bins_[i].pmf = static_cast<float>(scaled[i] / total);
    scaled[i] *= static_cast<double>(n) / total;
    (scaled[i] < 1 ? small : large).push_back(i);
  }
  while (!small.empty() && !large.empty()) {
    const uint32_t low = small.back(), high = large.back();
    small.pop_back();
    bins_[low].keep = static_cast<float>(scaled[low]);
    bins_[low].alias = high;
    scaled[high] -= 1 - scaled[low];
    if (scaled[high] < 1) {
      large.pop_back();
      small.push_back(high);
    }
  }
  // What rounding leaves over is full, but for an index of no weight.
  for (const uint32_t i : small) {
    if (bins_[i].pmf > 0) continue;
    bins_[i].keep = 0;
    bins_[i].alias = heaviest;
  }
}

uint32_t AliasTable::sample(double u) const {
  const double at = u * static_cast<double>(bins_.size());
  const auto i = static_cast<uint32_t>(std::min(at, static_cast<double>(bins_.size() - 1)));
  const Bin& bin = bins_[i];
  return at - static_cast<double>(i) < static_cast<double>(bin.keep) ? i : bin.alias;
}

}  // namespace lampyris
