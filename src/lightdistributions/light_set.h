// SPDX-License-Identifier: Apache-2.0
/// The lights of a scene as distributions want them: those with a position in a tree, the others
/// beside it.
#pragma once

#include <optional>
#include <vector>

#include "accelerators/wide_light_bvh.h"
#include "base/light_distribution.h"

namespace lampyris {

/// Infinite and distant lights, chosen by the irradiance that they would give a point.
/// Cost per draw or pmf: linear in their number.
class InfiniteLights {
 public:
  /// Those of the table that emit.
  explicit InfiniteLights(const LightTable& lights);

  bool empty() const { return lights_.empty(); }
  size_t size() const { return lights_.size(); }
  /// Luminance of the irradiance by all of them, W/m².
  double irradiance(const LightReceiver& at) const;
  /// One of them. `u` in [0, 1). None if no light can contribute.
  std::optional<SampledLight> sample(const LightReceiver& at, double u) const;
  /// What sample() reports; 0 for any other light.
  float pmf(const LightReceiver& at, LightId light) const;
  bool contains(LightId light) const;

 private:
  struct Entry {
    LightId id;
    const Light* light;
    float anywhere;  ///< irradiance where there is no surface: about the largest on any plane
    double irradiance(const LightReceiver& at) const;
  };
  std::vector<Entry> lights_;  ///< ascending ids
};

/// A tree of the table's lights with a position. Writes the tree's figures to the statistics.
LightBVHAccel makeLightTree(const LightDistributionContext& context);
/// Its wide form, with the statistics of that.
WideLightBVH makeWideLightTree(const LightBVHAccel& tree, const LightDistributionContext& context);

/// How often to choose among infinite lights rather than the tree, given the irradiance by either:
/// in proportion, but each at least a tenth, since both are estimates without visibility.
double infiniteShare(double infiniteIrradiance, double treeIrradiance);

}  // namespace lampyris
