// SPDX-License-Identifier: Apache-2.0
/// A cut through the wide light BVH that is fine where the BSDF is large, and draws from it.
///
/// Liu, Xu and Yan 2019, §4.1. A child of a node is split while the point lies in its bounding
/// sphere or the glossy lobes' integral over that exceeds a threshold; a cluster is drawn by its
/// importance, then one of eight children again and again. Deviations: the tree has eight children
/// a node, so that the root's are the coarsest clusters; where the BSDF is about the same for all
/// lights of a cluster, they are drawn by emission and distance alone; at most kMostNodes nodes are
/// looked at, the largest integral first, which bounds the work however many lights there are.
/// Cost: one evaluation of eight children (BrdfReceiver::weigh()) a node, and one a level below the
/// cut for each draw or pmf.
#pragma once

#include <optional>

#include "accelerators/wide_light_bvh.h"
#include "lightdistributions/brdf_receiver.h"

namespace lampyris {

class BrdfCut {
 public:
  static constexpr size_t kWidth = WideLightBVHNode::kWidth;
  static constexpr size_t kMostNodes = 31;
  static constexpr size_t kCapacity = kMostNodes * kWidth;  ///< clusters

  /// `tree` outlives the cut; may be empty.
  BrdfCut(const WideLightBVH& tree, const BrdfReceiver& at, float threshold);

  /// Clusters that can contribute.
  size_t size() const { return size_; }
  /// The largest integral of the glossy lobes over a cluster that can contribute.
  float largestIntegral() const { return largest_; }
  /// Sum of the clusters' importances.
  double importance() const { return total_; }
  /// The part of it that clusters of one light have.
  float shareOfSingleLights() const;

  /// None where no light can contribute. `u` in [0, 1).
  std::optional<SampledLight> sample(const BrdfReceiver& at, double u) const;
  /// What sample() reports for the light; 0 for a light that isn't in the tree.
  float pmf(const BrdfReceiver& at, LightId light) const;

 private:
  static constexpr uint8_t kWhole = 0xff;
  /// A node whose children are clusters, or split.
  struct Part {
    uint32_t node;
    uint8_t flat;                       ///< of the children, as bits
    double strongest;                   ///< intensity that the children's are relative to
    std::array<double, kWidth> weight;  ///< their importances; 0 of those that are split
    std::array<uint8_t, kWidth> part;   ///< of each child, where it is split; else kWhole
  };
  /// A child that is to be split if there is room.
  struct Wide {
    float integral;
    uint8_t part, lane;
  };
  /// All children of a node become clusters.
  void look(uint32_t node, double strongest, const BrdfReceiver& at, float threshold);
  void split(const Wide& which, const BrdfReceiver& at, float threshold);

  const WideLightBVH& tree_;
  size_t size_ = 0;
  float largest_ = 0;
  double total_ = 0;
  size_t partCount_ = 0;
  size_t wideCount_ = 0;
  std::array<Part, kMostNodes> parts_;     ///< the root first
  std::array<double, kMostNodes> totals_;  ///< importance of each part's clusters
  std::array<Wide, kCapacity> wide_;
};

}  // namespace lampyris
