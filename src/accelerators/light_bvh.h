// SPDX-License-Identifier: Apache-2.0
/// The light BVH: a binary tree over lights with positions, from which one is drawn in O(log n) by
/// its importance for a point.
///
/// Ma 2018, "Importance Sampling with Light BVH" (thesis), ch. 3: built by the surface area
/// orientation heuristic (§3.2, 3.3), flattened depth first (§3.3.7), descended by importance
/// (§3.4). Deviations: see light_bvh_builder.h and light_bvh_importance.h. Cost per sample or pmf:
/// two node importances a level.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "accelerators/light_bvh_importance.h"
#include "accelerators/light_bvh_node.h"
#include "core/huge_pages.h"

namespace lampyris {

struct LightBVHInput {
  LightId id = kNoLight;
  LightBounds bounds;
};

/// `u`, a float variate, with more digits: a descent of 20 levels uses up the 24 bits of a float.
/// The new ones are a hash of the point and `u`, so that the draw stays a function of them.
double refineVariate(float u, const Vec3& p);

/// Takes one of two alternatives with a probability in proportion to its weight, and leaves a fresh
/// variate in `u`. Never takes one of weight 0; not both are.
bool chooseFirst(double first, double second, double& u);

/// Immutable and thread-safe once built.
class LightBVHAccel {
 public:
  struct Stats {
    size_t lights = 0, nodes = 0, dropped = 0;
    uint32_t depth = 0;  ///< levels
    size_t bytes = 0;
  };

  LightBVHAccel() = default;
  /// Lights whose intensity isn't positive and finite, or whose box isn't finite, are dropped. Ids
  /// must be unique and below 2³¹ − 1; memory is linear in the largest one. Throws SceneError if
  /// there are too many. The tree doesn't depend on the number of threads.
  explicit LightBVHAccel(std::span<const LightBVHInput> lights);

  bool empty() const { return nodes_.empty(); }
  /// None where no light can contribute, found out at the root or on the way down. `u` in [0, 1),
  /// see refineVariate().
  std::optional<SampledLight> sample(const LightReceiver& at, double u) const;
  /// Exactly what sample() reports for the light; 0 for a light that isn't in the tree.
  float pmf(const LightReceiver& at, LightId light) const;
  /// About the luminance of the irradiance (W/m²) by all lights of the tree.
  float rootImportance(const LightReceiver& at) const;

  /// Depth first, see LinearLightBVHNode; empty or 2n − 1 of them.
  const HugeVector<LinearLightBVHNode>& nodes() const { return nodes_; }
  /// One more than the largest id of all lights, dropped ones as well.
  size_t idCount() const { return leafOf_.size(); }
  static constexpr uint32_t kNoLeaf = ~uint32_t{0};
  /// The light's node; kNoLeaf if it was dropped.
  uint32_t leafOf(LightId light) const { return light < leafOf_.size() ? leafOf_[light] : kNoLeaf; }
  /// Draws a light of the subtree at `node` by intensity alone. `u` in [0, 1).
  SampledLight sampleByIntensity(uint32_t node, double u) const;
  /// What sampleByIntensity(node, ·) reports for the light of a leaf within that subtree.
  float pmfByIntensity(uint32_t node, uint32_t leaf) const;

  const Stats& stats() const { return stats_; }

 private:
  HugeVector<LinearLightBVHNode> nodes_;
  std::vector<uint32_t> leafOf_;  ///< per light id
  Stats stats_;
};

}  // namespace lampyris
