// SPDX-License-Identifier: Apache-2.0
#include "core/rejections.h"

#include <atomic>

namespace lampyris {

namespace {

std::array<std::atomic<uint64_t>, kRejectionCount> counts{};

}  // namespace

void countRejection(Rejection what) {
  counts[static_cast<size_t>(what)].fetch_add(1, std::memory_order_relaxed);
}

RejectionCounts rejectionCounts() {
  RejectionCounts now{};
  for (size_t i = 0; i < kRejectionCount; ++i) now[i] = counts[i].load(std::memory_order_relaxed);
  return now;
}

const char* nameOf(Rejection what) {
  switch (what) {
    case Rejection::ScatteringDensity:
      return "density of scattering";
    case Rejection::LightDensity:
      return "density of a light";
    case Rejection::LightRadiance:
      return "light not finite";
    case Rejection::PathWeight:
      return "path not finite";
    case Rejection::MisWeight:
      return "weight not finite";
    case Rejection::Interfaces:
      return "endless interfaces";
    case Rejection::ProbeHits:
      return "endless probes";
    case Rejection::LearningSample:
      return "not learned from";
    case Rejection::Splat:
      return "bad splats";
    case Rejection::DarkenedSplat:
      return "darkened splats";
    case Rejection::DarkenedSample:
      return "darkened samples";
  }
  return "";
}

void reportRejections(Statistics& statistics, const RejectionCounts& before) {
  const RejectionCounts now = rejectionCounts();
  for (size_t i = 0; i < kRejectionCount; ++i)
    statistics.set(kRejectionSection, nameOf(static_cast<Rejection>(i)),
                   static_cast<double>(now[i] - before[i]));
}

}  // namespace lampyris
