// SPDX-License-Identifier: Apache-2.0
#include "integrators/bad_samples.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>

namespace lampyris {

namespace {

constexpr size_t kReported = 10;

}  // namespace

void BadSamples::add(const SampleAddress& address, const Rgb& radiance) {
  const bool nan = std::isnan(radiance.r) || std::isnan(radiance.g) || std::isnan(radiance.b);
  ++(nan ? nan_ : radiance.isFinite() ? negative_ : infinite_);
  if (first_.size() < kReported) first_.push_back(address);
}

void BadSamples::merge(const BadSamples& other) {
  nan_ += other.nan_;
  infinite_ += other.infinite_;
  negative_ += other.negative_;
  first_.insert(first_.end(), other.first_.begin(), other.first_.end());
  // In an order that does not depend on which tile was done first.
  std::sort(first_.begin(), first_.end(), [](const SampleAddress& a, const SampleAddress& b) {
    return std::tie(a.index, a.pixel.y, a.pixel.x) < std::tie(b.index, b.pixel.y, b.pixel.x);
  });
  if (first_.size() > kReported) first_.resize(kReported);
}

void BadSamples::report(Statistics& statistics) const {
  const auto count = [](uint64_t n) { return static_cast<double>(n); };
  statistics.add("bad samples", "not a number", count(nan_));
  statistics.add("bad samples", "infinite", count(infinite_));
  statistics.add("bad samples", "negative", count(negative_));
  if (first_.empty()) return;
  std::string list;
  for (const SampleAddress& a : first_)
    list += fmt::format("{}{},{} #{}", list.empty() ? "" : "; ", a.pixel.x, a.pixel.y, a.index);
  statistics.set("bad samples", "pixel x,y #sample", list);
}

}  // namespace lampyris
