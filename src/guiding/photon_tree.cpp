// SPDX-License-Identifier: Apache-2.0
#include "guiding/photon_tree.h"

#include <algorithm>

#include "core/bounds.h"

namespace lampyris {

PhotonTree::PhotonTree(std::vector<GuidePhoton> photons)
    : photons_(std::move(photons)), axes_(photons_.size()) {
  build(0, photons_.size());
}

void PhotonTree::build(size_t begin, size_t end) {
  if (end - begin < 2) return;
  Vec3 least = photons_[begin].p, most = least;
  for (size_t i = begin; i < end; ++i) {
    least = glm::min(least, photons_[i].p);
    most = glm::max(most, photons_[i].p);
  }
  const Vec3 size = most - least;
  const int axis = size.x > size.y ? (size.x > size.z ? 0 : 2) : (size.y > size.z ? 1 : 2);
  const size_t middle = begin + (end - begin) / 2;
  const auto at = [this](size_t i) { return photons_.begin() + static_cast<std::ptrdiff_t>(i); };
  std::nth_element(
      at(begin), at(middle), at(end),
      [axis](const GuidePhoton& a, const GuidePhoton& b) { return a.p[axis] < b.p[axis]; });
  axes_[middle] = static_cast<uint8_t>(axis);
  build(begin, middle);
  build(middle + 1, end);
}

struct PhotonTree::Search {
  Vec3 p;
  std::span<Near> found;  ///< a heap, the farthest first, once it is full
  size_t count = 0;

  void take(const Near& n) {
    if (count < found.size()) {
      found[count++] = n;
      if (count == found.size()) std::make_heap(found.begin(), found.end());
    } else if (n < found.front()) {
      std::pop_heap(found.begin(), found.end());
      found.back() = n;
      std::push_heap(found.begin(), found.end());
    }
  }
  bool wants(float squaredDistance) const {
    return count < found.size() || squaredDistance <= found.front().squaredDistance;
  }
};

void PhotonTree::search(size_t begin, size_t end, Search& s) const {
  if (begin == end) return;
  const size_t middle = begin + (end - begin) / 2;
  const GuidePhoton& photon = photons_[middle];
  const int axis = axes_[middle];
  const float offset = s.p[axis] - photon.p[axis];
  const bool upper = offset >= 0;
  search(upper ? middle + 1 : begin, upper ? end : middle, s);
  if (!s.wants(offset * offset)) return;
  s.take({lengthSquared(photon.p - s.p), static_cast<uint32_t>(middle)});
  search(upper ? begin : middle + 1, upper ? middle : end, s);
}

size_t PhotonTree::nearest(const Vec3& p, std::span<Near> found) const {
  Search s{p, found};
  if (!found.empty()) search(0, photons_.size(), s);
  return s.count;
}

}  // namespace lampyris
