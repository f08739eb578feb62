// SPDX-License-Identifier: Apache-2.0
/// A kd-tree of photons for the nearest ones of a point.
#pragma once

#include <span>
#include <vector>

#include "core/vector.h"

namespace lampyris {

/// A photon as a guide sees it.
struct GuidePhoton {
  Vec3 p{0};
  Vec3 wi{0, 0, 1};  ///< unit, towards where it comes from
  float power = 0;   ///< luminance, ≥ 0; all photons together carry the light's power
  Vec3 n{0};         ///< of the surface, on the side of wi
};

/// Each part of the array has its median in the middle, the lower ones before it.
class PhotonTree {
 public:
  struct Near {
    float squaredDistance;
    uint32_t photon;
    bool operator<(const Near& o) const {
      return squaredDistance != o.squaredDistance ? squaredDistance < o.squaredDistance
                                                  : photon < o.photon;
    }
  };

  explicit PhotonTree(std::vector<GuidePhoton> photons);

  /// Fills `found` with the photons nearest to `p`, in no order; returns how many there are.
  size_t nearest(const Vec3& p, std::span<Near> found) const;
  const GuidePhoton& operator[](uint32_t i) const { return photons_[i]; }
  size_t size() const { return photons_.size(); }

 private:
  struct Search;
  void build(size_t begin, size_t end);
  void search(size_t begin, size_t end, Search& s) const;

  std::vector<GuidePhoton> photons_;
  std::vector<uint8_t> axes_;
};

}  // namespace lampyris
