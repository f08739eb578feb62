// SPDX-License-Identifier: Apache-2.0
/// What a light BVH looks like, in plain records: for people who ask how good it is.
#pragma once

#include <cstdint>
#include <vector>

#include "core/bounds.h"

namespace lampyris {

class LightBVHAccel;

/// A node of the tree.
struct LightTreeNode {
  uint32_t depth = 0;   ///< of the root: 0
  uint32_t lights = 0;  ///< in the subtree
  bool leaf = false;
  Bounds3 box;
  double intensity = 0;  ///< sum of the lights' LightBounds::intensity
  double cost = 0;       ///< intensity × area × cone measure: the heuristic's cost of the cluster
};

/// The nodes down to `maxDepth`, depth first, left children first.
std::vector<LightTreeNode> lightTreeNodes(const LightBVHAccel& tree, uint32_t maxDepth);

/// The centres of up to `atMost` leaves: every nth in the order of the tree.
std::vector<Vec3> someLightPositions(const LightBVHAccel& tree, size_t atMost);

struct LightTreeReport {
  size_t lights = 0, nodes = 0, leaves = 0, bytes = 0;
  uint32_t leastDepth = 0, mostDepth = 0;  ///< of leaves
  double meanDepth = 0;                    ///< over the lights: of their leaves
  uint32_t largestLeaf = 0;                ///< lights in it
  double meanLeaf = 0;
  /// Surface area orientation heuristic of the whole tree (Ma 2018, §3.2): the costs of all nodes
  /// but the root, in units of the root's. About how much of the lights' bounds overlaps.
  double cost = 0;
  std::vector<size_t> nodesByDepth;
};
LightTreeReport reportLightTree(const LightBVHAccel& tree);

}  // namespace lampyris
