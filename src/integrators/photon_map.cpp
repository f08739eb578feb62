// SPDX-License-Identifier: Apache-2.0
#include "integrators/photon_map.h"

#include <bit>

#include "core/hash.h"

namespace lampyris {

PhotonMap::PhotonMap(std::vector<Photon> photons, float radius)
    : radius_(radius), inverseWidth_(0.5 / static_cast<double>(radius)) {
  // Counting sort by bucket; stable, so nothing depends on anything but the photons' order.
  starts_.assign(std::bit_ceil(photons.size() + 1) + 1, 0);
  std::vector<uint32_t> buckets(photons.size());
  for (size_t i = 0; i < photons.size(); ++i) {
    buckets[i] = static_cast<uint32_t>(bucketOf(cellAt(glm::dvec3(photons[i].p))));
    ++starts_[buckets[i] + 1];
  }
  for (size_t b = 1; b < starts_.size(); ++b) starts_[b] += starts_[b - 1];
  std::vector<uint32_t> next(starts_.begin(), starts_.end() - 1);
  photons_.resize(photons.size());
  for (size_t i = 0; i < photons.size(); ++i) photons_[next[buckets[i]]++] = photons[i];
}

size_t PhotonMap::bucketOf(const Cell& cell) const {
  const uint64_t h =
      hashCombine(hashCombine(static_cast<uint64_t>(cell.x), static_cast<uint64_t>(cell.y)),
                  static_cast<uint64_t>(cell.z));
  return static_cast<size_t>(h & (starts_.size() - 2));
}

}  // namespace lampyris
