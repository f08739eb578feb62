// SPDX-License-Identifier: Apache-2.0
/// Collapses the binary light BVH into the wide one.
#pragma once

#include "accelerators/wide_light_bvh.h"

namespace lampyris {

/// Takes subtrees as children so that nodes are full at the bottom (few bytes a light) and alike in
/// size at the top (few levels).
class WideLightBVHBuilder {
 public:
  WideLightBVHBuilder(const LightBVHAccel& tree, WideLightBVH& out);
  void build();

 private:
  /// A subtree of the binary tree: nodes first … end − 1.
  struct Subtree {
    uint32_t first, end;
    uint32_t lights() const { return (end - first + 1) / 2; }
  };
  using Children = std::array<Subtree, WideLightBVHNode::kWidth>;
  /// An inner node still to be filled in.
  struct Task {
    Subtree subtree;
    uint32_t node, depth;
  };

  size_t chooseChildren(const Subtree& root, Children& children) const;
  void open(Children& children, size_t& count, size_t which) const;
  void fill(const Task& task);

  const std::vector<LinearLightBVHNode>& binary_;
  WideLightBVH& out_;
  float leastExtent_;
  std::vector<Task> pending_;
};

}  // namespace lampyris
