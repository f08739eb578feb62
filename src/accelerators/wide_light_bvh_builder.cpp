// SPDX-License-Identifier: Apache-2.0
#include "accelerators/wide_light_bvh_builder.h"

#include <algorithm>

#include "core/bounds.h"

namespace lampyris {
namespace {

constexpr size_t kWidth = WideLightBVHNode::kWidth;
/// Least extent of a node, relative to the root's: bounds the ratio of distances to extents.
constexpr float kLeastExtent = 1e-10f;

/// What all children of a subtree of this many lights should hold: the largest power of the width
/// that leaves more than one child.
uint32_t targetSize(uint32_t lights) {
  uint64_t size = 1;
  while (size * kWidth < lights) size *= kWidth;
  return static_cast<uint32_t>(size);
}

}  // namespace

WideLightBVHBuilder::WideLightBVHBuilder(const LightBVHAccel& tree, WideLightBVH& out)
    : binary_(tree.nodes()), out_(out) {
  const Vec3 half = binary_.empty() ? Vec3(0) : binary_[0].halfExtent();
  const float extent = 2 * std::max({half.x, half.y, half.z});
  // Where all lights are at one place, any unit does.
  leastExtent_ = extent > 0 ? std::max(extent * kLeastExtent, 1e-30f) : 1;
}

void WideLightBVHBuilder::build() {
  if (binary_.empty()) return;
  out_.center_ = binary_[0].center();
  out_.radius2_ = dot(binary_[0].halfExtent(), binary_[0].halfExtent());
  const size_t lights = (binary_.size() + 1) / 2;
  out_.lights_.reserve(lights);
  out_.nodes_.reserve(lights / 4 + 8);
  out_.nodes_.emplace_back();
  pending_.push_back({{0, static_cast<uint32_t>(binary_.size())}, 0, 1});
  while (!pending_.empty()) {
    const Task task = pending_.back();
    pending_.pop_back();
    fill(task);
  }
  out_.nodes_.shrink_to_fit();
}

void WideLightBVHBuilder::open(Children& children, size_t& count, size_t which) const {
  const Subtree opened = children[which];
  const uint32_t right = binary_[opened.first].rightChild();
  // In the binary tree's order, so that neighbouring children are neighbours in space.
  for (size_t i = count; i > which + 1; --i) children[i] = children[i - 1];
  children[which] = {opened.first + 1, right};
  children[which + 1] = {right, opened.end};
  ++count;
}

size_t WideLightBVHBuilder::chooseChildren(const Subtree& root, Children& children) const {
  size_t count = 1;
  children[0] = root;
  const auto largest = [&] {
    return static_cast<size_t>(
        std::max_element(
            children.begin(), children.begin() + static_cast<ptrdiff_t>(count),
            [](const Subtree& a, const Subtree& b) { return a.end - a.first < b.end - b.first; }) -
        children.begin());
  };
  const uint32_t target = targetSize(root.lights());
  while (count < kWidth) {
    const size_t i = largest();
    if (children[i].lights() <= target) break;
    open(children, count, i);
  }
  // What is left over takes in whole subtrees, the small ones first: each saves a node.
  for (uint32_t size = 2; size <= kWidth - count + 1; ++size)
    for (size_t i = 0; i < count; ++i)
      while (children[i].lights() > 1 && children[i].lights() <= size &&
             children[i].lights() <= kWidth - count + 1)
        open(children, count, i);
  return count;
}

void WideLightBVHBuilder::fill(const Task& task) {
  Children children;
  const size_t count = chooseChildren(task.subtree, children);
  std::array<const LinearLightBVHNode*, kWidth> nodes{};
  for (size_t i = 0; i < count; ++i) nodes[i] = &binary_[children[i].first];
  WideLightBVHNode encoded;
  const float strongest = encoded.encode({nodes.data(), count}, leastExtent_);
  if (task.node == 0) out_.strongest_ = strongest;
  encoded.parent = out_.nodes_[task.node].parent;
  encoded.firstLight = static_cast<uint32_t>(out_.lights_.size());
  encoded.firstChild = static_cast<uint32_t>(out_.nodes_.size());
  out_.nodes_[task.node] = encoded;
  out_.stats_.depth = std::max(out_.stats_.depth, task.depth);
  for (size_t i = 0; i < count; ++i) {
    const uint32_t slot = task.node * static_cast<uint32_t>(kWidth) + static_cast<uint32_t>(i);
    if (nodes[i]->isLeaf()) {
      out_.slotOf_[nodes[i]->light()] = slot;
      out_.lights_.push_back(nodes[i]->light());
    } else {
      pending_.push_back({children[i], static_cast<uint32_t>(out_.nodes_.size()), task.depth + 1});
      out_.nodes_.emplace_back().parent = slot;
    }
  }
}

}  // namespace lampyris
