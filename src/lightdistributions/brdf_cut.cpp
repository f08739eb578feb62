// SPDX-License-Identifier: Apache-2.0
#include "lightdistributions/brdf_cut.h"

#include "accelerators/light_bvh.h"

namespace lampyris {

namespace {

/// A way down the tree from a cluster. Sampling and pmf both take it.
class Descent {
 public:
  Descent(std::span<const LinearLightBVHNode> nodes, const BrdfReceiver& at, uint32_t from,
          bool flat)
      : nodes_(nodes), at_(at), node_(from), flat_(flat) {}

  uint32_t node() const { return node_; }
  bool atLeaf() const { return nodes_[node_].isLeaf(); }
  /// Goes to the child that choose(left importance, right importance, right child) says (true:
  /// left). Returns the probability of that; 0 if no child can contribute.
  template <class Choose>
  double step(const Choose& choose) {
    const uint32_t leftNode = node_ + 1, rightNode = nodes_[node_].rightChild();
    // The next level's nodes, as in childImportances().
    __builtin_prefetch(nodes_.data() + nodes_[leftNode].light());
    __builtin_prefetch(nodes_.data() + nodes_[rightNode].light());
    const BrdfReceiver::Estimate left = estimate(leftNode), right = estimate(rightNode);
    const double sum = left.importance + right.importance;
    if (!(sum > 0)) return 0;
    const bool goLeft = choose(left.importance, right.importance, rightNode);
    node_ = goLeft ? leftNode : rightNode;
    flat_ = flat_ || (goLeft ? left : right).flat;
    return (goLeft ? left : right).importance / sum;
  }

 private:
  BrdfReceiver::Estimate estimate(uint32_t node) const {
    if (!flat_) return at_.estimate(nodes_[node]);
    return {at_.emission(nodes_[node])};
  }
  std::span<const LinearLightBVHNode> nodes_;
  const BrdfReceiver& at_;
  uint32_t node_;
  bool flat_;
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
    clusters_[size_++] = {i, e.flat, e.importance};
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
  Descent way(nodes_, at, chosen->node, chosen->flat);
  while (!way.atLeaf() && pmf > 0)
    pmf *= way.step([&u](double l, double r, uint32_t) { return chooseFirst(l, r, u); });
  if (!(pmf > 0)) return std::nullopt;
  return SampledLight{nodes_[way.node()].light(), static_cast<float>(pmf)};
}

float BrdfCut::pmf(const BrdfReceiver& at, uint32_t leaf) const {
  if (!(total_ > 0)) return 0;
  const auto end = clusters_.begin() + static_cast<ptrdiff_t>(size_);
  const Cluster& cluster =
      *(std::upper_bound(clusters_.begin(), end, leaf,
                         [](uint32_t node, const Cluster& c) { return node < c.node; }) -
        1);
  double pmf = cluster.importance / total_;
  Descent way(nodes_, at, cluster.node, cluster.flat);
  while (way.node() != leaf && pmf > 0)
    pmf *= way.step([leaf](double, double, uint32_t right) { return leaf < right; });
  return static_cast<float>(pmf);
}

}  // namespace lampyris
