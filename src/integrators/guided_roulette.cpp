// SPDX-License-Identifier: Apache-2.0
#include "integrators/guided_roulette.h"

#include <algorithm>

namespace lampyris {

/// With what probability a path of this throughput ends.
float GuidedRoulette::end(const VolumePath& path, float throughput) const {
  const float most = throughput * path.etaScale;
  return path.bounces <= kFirstBounce || !(most < threshold_) ? 0 : std::max(0.05f, 1 - most);
}

/// After a draw that the path has survived with the probability `chance`.
void GuidedRoulette::goOn(VolumePath& path, float chance) const {
  path.odds *= static_cast<double>(chance / (1 - end(path, path.unguidedThroughput())));
  if (chance < 1) path.throughput /= chance;
}

/// By what the throughput would be without a guide: a guide draws directions that matter more
/// often, for which their throughput is smaller. (By the larger of the two, so that it blows up no
/// path that went against the guide.)
bool GuidedRoulette::drawByThroughput(VolumePath& path) const {
  const float chance =
      1 - end(path, std::max(path.throughput.maxComponent(), path.unguidedThroughput()));
  if (chance < 1) {
    path.setDimension(VolumePath::kRouletteOffset);
    if (path.stream.next1D() < 1 - chance) return false;
  }
  goOn(path, chance);
  return true;
}

bool GuidedRoulette::survivesByPromise(VolumePath& path, float scattered) const {
  constexpr float kDispensable = 0.9f, kLeast = 0.5f;
  const float expected = path.throughput.luminance() * scattered;
  if (!(path.promise > 0)) {
    path.promise = expected;
    return true;
  }
  const float worth = expected / (kDispensable * path.promise);
  const float chance = worth < 1 ? std::max(kLeast, worth) : 1.f;
  if (chance < 1 && path.numbers.next() >= chance) return false;
  goOn(path, chance);
  return true;
}

}  // namespace lampyris
