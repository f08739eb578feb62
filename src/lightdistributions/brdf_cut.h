// SPDX-License-Identifier: Apache-2.0
/// A cut through the light BVH that is fine where the BSDF is large, and draws from it.
///
/// Liu, Xu and Yan 2019, §4.1. From the root on, a node is split while the point lies in its
/// bounding sphere or the glossy lobes' integral over that exceeds a threshold; a cluster is drawn
/// by its importance, then one of two children again and again. Deviations: where the BSDF is about
/// the same for all lights of a node, they are drawn by emission and distance alone; at most
/// kCapacity clusters; where that is too few, the threshold is doubled until it does. Cost: one
/// node estimate for each node visited, about twice the clusters.
#pragma once

#include <span>

#include "lightdistributions/brdf_receiver.h"

namespace lampyris {

class BrdfCut {
 public:
  static constexpr size_t kCapacity = 128;

  /// `nodes` outlives the cut; may be empty.
  BrdfCut(std::span<const LinearLightBVHNode> nodes, const BrdfReceiver& at, float threshold);

  size_t size() const { return size_; }
  /// The largest integral of the glossy lobes over a cluster that contributes.
  float largestIntegral() const { return largest_; }
  /// Sum of the clusters' importances.
  double importance() const { return total_; }

  /// None where no light can contribute. `u` in [0, 1).
  std::optional<SampledLight> sample(const BrdfReceiver& at, double u) const;
  /// What sample() reports for the light of a leaf.
  float pmf(const BrdfReceiver& at, uint32_t leaf) const;

 private:
  struct Cluster {
    uint32_t node;
    bool flat;
    double importance;
  };
  /// False if there would be too many clusters; `fillUp`: nodes that find no room stay whole.
  bool build(const BrdfReceiver& at, float threshold, bool fillUp);

  std::span<const LinearLightBVHNode> nodes_;
  size_t size_ = 0;
  float largest_ = 0;
  double total_ = 0;
  std::array<Cluster, kCapacity> clusters_;  ///< ascending nodes: their subtrees are all the tree
};

}  // namespace lampyris
