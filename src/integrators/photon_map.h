// SPDX-License-Identifier: Apache-2.0
/// Photons in a grid, to be found around a point.
#pragma once

#include <cstdint>
#include <vector>

#include "core/rgb.h"
#include "core/vector.h"

namespace lampyris {

struct Photon {
  Vec3 p{0};
  Vec3 wi{0, 0, 1};  ///< unit, towards where it comes from
  Vec3 n{0, 0, 1};   ///< geometric normal of the surface that it has met
  Rgb power;
};

/// A hash grid whose cells are as wide as a search: it looks into at most eight of them. What it
/// finds comes in the order in which photons were given.
class PhotonMap {
 public:
  PhotonMap() = default;
  /// `radius` > 0: that of all searches.
  PhotonMap(std::vector<Photon> photons, float radius);

  /// visit(photon) for all within the radius of `p`.
  template <class Visit>
  void search(const Vec3& p, const Visit& visit) const;
  size_t size() const { return photons_.size(); }

 private:
  using Cell = glm::i64vec3;
  Cell cellAt(const glm::dvec3& p) const {
    // Beyond this all lies in one cell: integers end.
    return {glm::clamp(glm::floor(p * inverseWidth_), glm::dvec3(-0x1p60), glm::dvec3(0x1p60))};
  }
  size_t bucketOf(const Cell& cell) const;

  std::vector<Photon> photons_;   ///< bucket by bucket
  std::vector<uint32_t> starts_;  ///< of each bucket, and the end
  float radius_ = 1;
  double inverseWidth_ = 0;
};

template <class Visit>
void PhotonMap::search(const Vec3& p, const Visit& visit) const {
  if (photons_.empty()) return;
  const glm::dvec3 at(p), r(static_cast<double>(radius_));
  const Cell first = cellAt(at - r), last = cellAt(at + r);
  for (auto z = first.z; z <= last.z; ++z)
    for (auto y = first.y; y <= last.y; ++y)
      for (auto x = first.x; x <= last.x; ++x) {
        const Cell cell(x, y, z);
        const size_t bucket = bucketOf(cell);
        for (uint32_t i = starts_[bucket]; i < starts_[bucket + 1]; ++i) {
          const Photon& photon = photons_[i];
          if (lengthSquared(photon.p - p) > radius_ * radius_) continue;
          // Other cells may share the bucket, even cells of this search.
          if (cellAt(glm::dvec3(photon.p)) == cell) visit(photon);
        }
      }
}

}  // namespace lampyris
