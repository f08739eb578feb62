// SPDX-License-Identifier: Apache-2.0
/// The wide light BVH: the binary tree of light_bvh.h with up to eight children a node, all of
/// which are weighed at once.
///
/// One choice among eight replaces three chained choices among two: a third of the cache misses,
/// and less noise, since every chained choice adds that of its coarser bounds. Cost per sample or
/// pmf: one evaluation of eight importances a level, with a third of the binary tree's levels.
///
/// Splitting: Conty and Kulla 2018, "Importance Sampling of Many Lights with Adaptive Tree
/// Splitting". A cluster that is near for its size is replaced by parts of it, each of which gives
/// a light. Deviations: the cut is a function of the point alone; its size is bounded by a budget
/// that is handed down the tree in proportion to importance, so that the way from the root to a
/// light is all that its expected count depends on. See docs/light-bvh.md.
#pragma once

#include "accelerators/light_bvh.h"
#include "accelerators/wide_light_bvh_node.h"

namespace lampyris {

struct ChildWeights;

/// When a cluster of lights gives more than one light.
class LightSplitting {
 public:
  /// `threshold` in [0, 1]: a cluster is split where 1 − (1 + CV)^(−1/4) is more, with CV the
  /// coefficient of variation of 1/d² over its bounding sphere. 1: never; 0: always. `maxCut`: the
  /// most lights that a point gets, at least 1.
  LightSplitting(float threshold, uint32_t maxCut);

  /// With `worth` (in [0, 1]) as many lights at most.
  LightSplitting forPoint(float worth) const;

  bool never() const { return maxCut_ <= 1; }
  uint32_t maxCut() const { return maxCut_; }
  /// A cluster is split where its squared radius is at least this times the squared length of the
  /// tangent to its bounding sphere.
  float ratio() const { return ratio_; }
  /// Whether each of so many lights is shaded, whatever their importance.
  bool takesAll(size_t lights) const { return ratio_ == 0 && maxCut_ >= lights; }

 private:
  float ratio_;
  uint32_t maxCut_;
};

/// Immutable and thread-safe once built.
class WideLightBVH {
 public:
  struct Stats {
    size_t lights = 0, nodes = 0;
    uint32_t depth = 0;  ///< levels
    size_t bytes = 0;
  };

  WideLightBVH() = default;
  /// The tree's lights and clusters; the tree itself is no longer needed then.
  explicit WideLightBVH(const LightBVHAccel& tree);

  bool empty() const { return nodes_.empty(); }
  /// None where no light can contribute, found out at the root or on the way down. `u` in [0, 1),
  /// see refineVariate().
  std::optional<SampledLight> sample(const LightReceiver& at, double u) const;
  /// Exactly what sample() reports for the light; 0 for a light that isn't in the tree.
  float pmf(const LightReceiver& at, LightId light) const;
  /// About the luminance of the irradiance (W/m²) by all lights of the tree.
  float rootImportance(const LightReceiver& at) const;
  /// For others that draw from the nodes: the light of a leaf, the nodes above a light
  /// (wide_light_bvh_way.h), and the intensity that those of the root's children are relative to.
  LightId lightAt(const WideLightBVHNode& node, size_t lane) const {
    return lights_[node.light(lane)];
  }
  class Way;
  float strongest() const { return strongest_; }

  /// Appends one light for each cluster of the point's cut, with its expected count.
  void sampleCut(const LightReceiver& at, double u, const LightSplitting& splitting,
                 SampledLights& out) const;
  /// Exactly what sampleCut() reports for the light.
  float expectedCount(const LightReceiver& at, LightId light,
                      const LightSplitting& splitting) const;

  const HugeVector<WideLightBVHNode>& nodes() const { return nodes_; }
  const Stats& stats() const { return stats_; }

 private:
  friend class WideLightBVHBuilder;
  class Cut;

  static constexpr uint32_t kNone = ~uint32_t{0};

  /// The cluster that one light is drawn from by intensity where that child is chosen; none if it
  /// is a leaf, no cluster, or one whose lights differ as seen from the point.
  const WideLightBVHNode* alikeCluster(const WideLightBVHNode& node, const ChildWeights& weights,
                                       size_t lane) const;
  static constexpr uint32_t kWhole = 65536;
  /// What a cluster has of the units of the largest one that it is in.
  struct Units {
    uint32_t begin, end;
  };
  Units unitsOf(uint32_t firstLight, uint32_t count) const;
  /// Where a descent ends: at one light, or at a cluster from which one is yet to be drawn by
  /// intensity. What resolve() reads is being fetched.
  struct Descent {
    const WideLightBVHNode* cluster;  ///< null: at one light
    uint32_t place;                   ///< in the list of lights; in a cluster about there
    double u, count;
  };
  Descent endAt(const WideLightBVHNode& cluster, double u, double count) const;
  SampledLight resolve(const Descent& end) const;
  /// The probability of the draw by intensity for the light at that place.
  double shareOfIntensity(const WideLightBVHNode& cluster, uint32_t place) const;
  /// Fetches all that a choice among the node's children may need next, while it is made.
  void prefetchBelow(const WideLightBVHNode& node) const;
  std::optional<Descent> descend(uint32_t node, const LightReceiver& at, double u,
                                 double count) const;
  void split(uint32_t node, uint32_t budget, Cut& cut) const;
  /// How many lights the whole tree may give to the point.
  uint32_t rootBudget(const LightReceiver& at, const LightSplitting& splitting) const;

  HugeVector<WideLightBVHNode> nodes_;
  HugeVector<uint32_t> parents_;  ///< per node: 8 × parent + lane there; kNone for the root
  HugeVector<LightId> lights_;    ///< by leaf
  /// Per leaf: the intensities of all before it in the largest cluster that it is in. In units of
  /// which that has kWhole, and each of its lights one at least. Empty without clusters.
  HugeVector<uint16_t> intensitiesBefore_;
  HugeVector<uint32_t> slotOf_;  ///< per light id: 8 × node + lane, or kNone
  float strongest_ = 0;          ///< intensity of the root's strongest child
  Vec3 center_{0};               ///< of the root's bounding sphere
  float radius2_ = 0;            ///< its squared radius
  Stats stats_;
};

}  // namespace lampyris
