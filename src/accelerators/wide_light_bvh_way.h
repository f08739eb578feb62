// SPDX-License-Identifier: Apache-2.0
/// The nodes on the way from the root of the wide light BVH to a light.
#pragma once

#include "accelerators/wide_light_bvh.h"

namespace lampyris {

class WideLightBVH::Way {
 public:
  Way(const WideLightBVH& tree, LightId light) {
    if (light >= tree.slotOf_.size()) return;
    for (uint32_t slot = tree.slotOf_[light]; slot != kNone;) {
      slots_[length_++] = slot;
      slot = tree.parents_[slot / WideLightBVHNode::kWidth];
    }
  }
  bool empty() const { return length_ == 0; }
  /// The light's place in the tree's list of lights.
  uint32_t place(const WideLightBVH& tree) const {
    return tree.nodes_[slots_[0] / WideLightBVHNode::kWidth].light(slots_[0] %
                                                                   WideLightBVHNode::kWidth);
  }
  /// Calls step(node, lane) from the root on until it returns false.
  template <class Step>
  void follow(const WideLightBVH& tree, const Step& step) const {
    for (size_t i = length_; i-- > 0;)
      if (!step(tree.nodes_[slots_[i] / WideLightBVHNode::kWidth],
                slots_[i] % WideLightBVHNode::kWidth))
        return;
  }

 private:
  /// More than the binary tree has levels.
  std::array<uint32_t, 100> slots_;
  size_t length_ = 0;
};

}  // namespace lampyris
