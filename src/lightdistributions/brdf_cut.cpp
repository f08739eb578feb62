// SPDX-License-Identifier: Apache-2.0
#include "lightdistributions/brdf_cut.h"

#include "accelerators/light_bvh.h"

namespace lampyris {

namespace {

struct Children {
  uint32_t left, right;
  double leftImportance, rightImportance;

  Children(std::span<const LinearLightBVHNode> nodes, uint32_t parent, const BrdfReceiver& at)
      : left(parent + 1),
        right(nodes[parent].rightChild()),
        leftImportance(at.importance(nodes[left])),
        rightImportance(at.importance(nodes[right])) {}
  double sum() const { return leftImportance + rightImportance; }
};

}  // namespace

BrdfCut::BrdfCut(std::span<const LinearLightBVHNode> nodes, const BrdfReceiver& at, float threshold)
    : nodes_(nodes) {
  if (nodes.empty()) return;
  // No integral exceeds the albedo: beyond it only nodes that the point lies in are split.
  const float last = at.glossyAlbedo();
  while (!build(at, threshold, threshold >= last))
    threshold = std::max(2 * threshold, 1e-3f * last);
}

bool BrdfCut::build(const BrdfReceiver& at, float threshold, bool fillUp) {
  size_ = 0;
  total_ = 0;
  largest_ = 0;
  std::array<uint32_t, kCapacity> pending;
  size_t count = 1;
  pending[0] = 0;
  while (count > 0) {
    const uint32_t i = pending[--count];
    const BrdfReceiver::Estimate e = at.estimate(nodes_[i]);
    const bool wide = e.importance > 0 && (e.inside || e.integral > threshold);
    if (wide && !nodes_[i].isLeaf()) {
      if (size_ + count + 2 <= kCapacity) {
        // The left one is taken next: clusters come in the order of their nodes.
        pending[count++] = nodes_[i].rightChild();
        pending[count++] = i + 1;
        continue;
      }
      if (!fillUp) return false;
    }
    clusters_[size_++] = {i, e.importance};
    total_ += e.importance;
    if (e.importance > 0) largest_ = std::max(largest_, e.integral);
  }
  return true;
}

std::optional<SampledLight> BrdfCut::sample(const BrdfReceiver& at, double u) const {
  if (!(total_ > 0)) return std::nullopt;
  double left = u * total_;
  const Cluster* chosen = nullptr;
  for (size_t k = 0; k < size_; ++k) {
    if (!(clusters_[k].importance > 0)) continue;
    chosen = &clusters_[k];
    if (left < chosen->importance) break;
    left -= chosen->importance;
  }
  // Rounding may leave more than the last one has.
  u = std::min(left / chosen->importance, 1 - DBL_EPSILON);
  double pmf = chosen->importance / total_;
  uint32_t i = chosen->node;
  while (!nodes_[i].isLeaf()) {
    const Children children(nodes_, i, at);
    if (!(children.sum() > 0)) return std::nullopt;
    const bool goLeft = chooseFirst(children.leftImportance, children.rightImportance, u);
    pmf *= (goLeft ? children.leftImportance : children.rightImportance) / children.sum();
    i = goLeft ? children.left : children.right;
  }
  return SampledLight{nodes_[i].light(), static_cast<float>(pmf)};
}

float BrdfCut::pmf(const BrdfReceiver& at, uint32_t leaf) const {
  if (!(total_ > 0)) return 0;
  const auto end = clusters_.begin() + static_cast<ptrdiff_t>(size_);
  const Cluster& cluster =
      *(std::upper_bound(clusters_.begin(), end, leaf,
                         [](uint32_t node, const Cluster& c) { return node < c.node; }) -
        1);
  double pmf = cluster.importance / total_;
  for (uint32_t i = cluster.node; i != leaf && pmf > 0;) {
    const Children children(nodes_, i, at);
    if (!(children.sum() > 0)) return 0;
    const bool goLeft = leaf < children.right;
    pmf *= (goLeft ? children.leftImportance : children.rightImportance) / children.sum();
    i = goLeft ? children.left : children.right;
  }
  return static_cast<float>(pmf);
}

}  // namespace lampyris
