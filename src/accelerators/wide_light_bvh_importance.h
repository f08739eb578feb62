// SPDX-License-Identifier: Apache-2.0
/// Importances of all children of a node of the wide light BVH at once: the same formula as for a
/// node of the binary tree (light_bvh_importance.h), in the node's own units.
#pragma once

#include "accelerators/light_bvh_importance.h"
#include "accelerators/wide_light_bvh_node.h"

namespace lampyris {

/// Importances of a node's children but for a factor that they share; 0 where there is none.
struct ChildWeights {
  alignas(32) std::array<float, WideLightBVHNode::kWidth> of;
  /// Sums up to and with each.
  std::array<double, WideLightBVHNode::kWidth> upTo;
  /// Positive for children whose lights differ in nothing but intensity, as seen from the point.
  alignas(32) std::array<float, WideLightBVHNode::kWidth> alike;
  /// The squared length that they are relative to, in the node's units.
  float unit2;

  double total() const { return upTo.back(); }
};

ChildWeights importances(const WideLightBVHNode& node, const LightReceiver& at);

/// The children (as bits) whose bounding sphere, of squared radius r² at distance d, has
/// r² ≥ ratio · (d² − r²).
uint8_t nearChildren(const WideLightBVHNode& node, const Vec3& p, float ratio);

}  // namespace lampyris
