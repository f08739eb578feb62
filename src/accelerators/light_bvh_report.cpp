// SPDX-License-Identifier: Apache-2.0
#include "accelerators/light_bvh_report.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "accelerators/light_bvh.h"

namespace lampyris {
namespace {

using std::numbers::pi;

/// Ma 2018, eq. 3.3: the measure of the directions that a cone emits to.
double coneMeasure(double thetaO, double thetaE) {
  const double thetaW = std::min(thetaO + thetaE, pi);
  const double falloff =
      2 * (thetaW - thetaO) * std::sin(thetaO) - std::cos(2 * thetaW - thetaO) + std::cos(thetaO);
  return 2 * pi * (1 - std::cos(thetaO)) + pi / 2 * falloff;
}

/// With the squared diagonal added, as the builder does: lights on a line have no surface area.
double area(const Bounds3& box) {
  const glm::dvec3 e(box.extent());
  return 2 * (e.x * e.y + e.y * e.z + e.z * e.x) + glm::dot(e, e);
}

LightTreeNode describe(const LinearLightBVHNode& node, uint32_t depth, uint32_t lights) {
  LightTreeNode d;
  d.depth = depth;
  d.lights = lights;
  d.leaf = node.isLeaf();
  d.box = Bounds3(node.center() - node.halfExtent(), node.center() + node.halfExtent());
  d.intensity = static_cast<double>(node.intensity());
  const double thetaO =
      node.allNormals() ? pi : 2 * std::asin(std::min(1., static_cast<double>(node.halfSineO())));
  const double thetaE = std::acos(std::clamp(static_cast<double>(node.cosThetaE()), -1., 1.));
  d.cost = d.intensity * area(d.box) * coneMeasure(thetaO, thetaE);
  return d;
}

/// Calls f for each node down to a depth, depth first.
template <class F>
void walk(const LightBVHAccel& tree, uint32_t maxDepth, F&& f) {
  struct Range {
    uint32_t node, end, depth;  ///< nodes of the subtree lie in [node, end)
  };
  const auto& nodes = tree.nodes();
  std::vector<Range> stack;
  if (!nodes.empty()) stack.push_back({0, static_cast<uint32_t>(nodes.size()), 0});
  while (!stack.empty()) {
    const Range r = stack.back();
    stack.pop_back();
    const LinearLightBVHNode& node = nodes[r.node];
    f(describe(node, r.depth, (r.end - r.node + 1) / 2));
    if (node.isLeaf() || r.depth == maxDepth) continue;
    stack.push_back({node.rightChild(), r.end, r.depth + 1});
    stack.push_back({r.node + 1, node.rightChild(), r.depth + 1});
  }
}

}  // namespace

std::vector<LightTreeNode> lightTreeNodes(const LightBVHAccel& tree, uint32_t maxDepth) {
  std::vector<LightTreeNode> nodes;
  walk(tree, maxDepth, [&](const LightTreeNode& n) { nodes.push_back(n); });
  return nodes;
}

std::vector<Vec3> someLightPositions(const LightBVHAccel& tree, size_t atMost) {
  const size_t leaves = (tree.nodes().size() + 1) / 2;
  const size_t step = std::max<size_t>((leaves + atMost - 1) / atMost, 1);
  std::vector<Vec3> positions;
  size_t leaf = 0;
  for (const LinearLightBVHNode& node : tree.nodes())
    if (node.isLeaf() && leaf++ % step == 0) positions.push_back(node.center());
  return positions;
}

LightTreeReport reportLightTree(const LightBVHAccel& tree) {
  LightTreeReport r;
  r.bytes = tree.stats().bytes;
  double rootCost = 0, costs = 0, depths = 0;
  walk(tree, ~uint32_t{0}, [&](const LightTreeNode& n) {
    if (r.nodes++ == 0)
      rootCost = n.cost;
    else
      costs += n.cost;
    if (r.nodesByDepth.size() <= n.depth) r.nodesByDepth.resize(n.depth + 1);
    ++r.nodesByDepth[n.depth];
    if (!n.leaf) return;
    r.leastDepth = r.leaves++ == 0 ? n.depth : std::min(r.leastDepth, n.depth);
    r.mostDepth = std::max(r.mostDepth, n.depth);
    r.largestLeaf = std::max(r.largestLeaf, n.lights);
    r.lights += n.lights;
    depths += static_cast<double>(n.depth) * n.lights;
  });
  if (r.lights > 0) {
    r.meanDepth = depths / static_cast<double>(r.lights);
    r.meanLeaf = static_cast<double>(r.lights) / static_cast<double>(r.leaves);
  }
  r.cost = rootCost > 0 ? costs / rootCost : 0;
  return r;
}

}  // namespace lampyris
