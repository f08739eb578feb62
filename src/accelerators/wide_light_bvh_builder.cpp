// SPDX-License-Identifier: Apache-2.0
#include "accelerators/wide_light_bvh_builder.h"

#include <algorithm>
#include <numeric>

#include "core/bounds.h"
#include "core/parallel.h"

namespace lampyris {
namespace {

constexpr size_t kWidth = WideLightBVHNode::kWidth;
/// Least extent of a node, relative to the root's: bounds the ratio of distances to extents.
constexpr float kLeastExtent = 1e-10f;
/// Lights of a piece of the tree that one thread collapses.
constexpr uint32_t kPieceLights = 16384;
/// The most lights of a cluster whose lights differ in intensity.
constexpr uint32_t kClusterLights = 2048;
/// Lights count as equally strong if none is stronger than another by more than this factor.
constexpr float kEven = 1.05f;
/// Trees of so few lights have no clusters.
constexpr uint32_t kFewLights = 512;
/// The fewest units of intensity for each light of a cluster that is drawn from by them.
constexpr uint32_t kUnitsPerLight = 16;

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

  const Subtree all{0, static_cast<uint32_t>(binary_.size())};
  hasClusters_ = all.lights() > kFewLights;
  Piece top;
  start(top, {all, 0, 1}, WideLightBVH::kNone);
  std::vector<Task> roots;
  collapse(top, all.lights() > kPieceLights ? kPieceLights : 0, roots);
  std::vector<Piece> pieces(roots.size());
  parallelFor(roots.size(), 1, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) {
      std::vector<Task> none;
      start(pieces[i], {roots[i].subtree, 0, roots[i].depth}, top.parents[roots[i].node]);
      collapse(pieces[i], 0, none);
      addIntensities(pieces[i]);
    }
  });

  if (hasClusters_) addIntensities(top);

  std::vector<Place> places;
  Place next{0, static_cast<uint32_t>(top.nodes.size()), static_cast<uint32_t>(top.lights.size())};
  out_.stats_.depth = top.depth;
  for (size_t i = 0; i < pieces.size(); ++i) {
    next.root = roots[i].node;
    places.push_back(next);
    next.firstNode += static_cast<uint32_t>(pieces[i].nodes.size() - 1);
    next.firstLight += static_cast<uint32_t>(pieces[i].lights.size());
    out_.stats_.depth = std::max(out_.stats_.depth, pieces[i].depth);
  }
  out_.nodes_.resize(next.firstNode);
  out_.parents_.resize(next.firstNode);
  out_.lights_.resize(next.firstLight);
  if (hasClusters_) {
    out_.intensitiesBefore_.resize(next.firstLight + 1);
    out_.intensitiesBefore_.back() = 0;
  }
  place(top, {0, 1, 0});
  parallelFor(pieces.size(), 1, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) place(pieces[i], places[i]);
  });
}

void WideLightBVHBuilder::start(Piece& piece, const Task& root, uint32_t parent) const {
  piece.nodes.emplace_back();
  piece.parents.push_back(parent);
  piece.pending.push_back(root);
  const Subtree& s = root.subtree;
  if (!hasClusters_ || s.lights() > kPieceLights) return;
  piece.firstRange = s.first;
  piece.ranges.resize(s.end - s.first);
  // Children have higher numbers than their parents.
  for (uint32_t i = s.end; i-- > s.first;) {
    Range& range = piece.ranges[i - s.first];
    if (binary_[i].isLeaf()) {
      range.least = range.most = binary_[i].intensity();
    } else {
      const Range& left = piece.ranges[i + 1 - s.first];
      const Range& right = piece.ranges[binary_[i].rightChild() - s.first];
      range = {std::min(left.least, right.least), std::max(left.most, right.most)};
    }
  }
}

bool WideLightBVHBuilder::isEven(const Piece& piece, const Subtree& subtree) {
  const Range& range = piece.ranges[subtree.first - piece.firstRange];
  return range.most <= kEven * range.least;
}

bool WideLightBVHBuilder::isCluster(const Piece& piece, const Subtree& subtree) const {
  // Of larger subtrees the lights do not lie side by side.
  if (!hasClusters_ || subtree.lights() > kPieceLights) return false;
  if (subtree.lights() > kClusterLights && !isEven(piece, subtree)) return false;
  // Emitters that together face all ways look different from anywhere.
  const auto first = binary_.begin() + subtree.first, end = binary_.begin() + subtree.end;
  return !first->allNormals() ||
         std::all_of(first, end, [](const LinearLightBVHNode& n) { return n.allNormals(); });
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

void WideLightBVHBuilder::collapse(Piece& piece, uint32_t leave, std::vector<Task>& aside) const {
  while (!piece.pending.empty()) {
    const Task task = piece.pending.back();
    piece.pending.pop_back();
    if (task.subtree.lights() <= leave) {
      aside.push_back(task);
    } else {
      fill(task, piece);
    }
  }
}

void WideLightBVHBuilder::fill(const Task& task, Piece& piece) const {
  Children children;
  const size_t count = chooseChildren(task.subtree, children);
  std::array<const LinearLightBVHNode*, kWidth> nodes{};
  for (size_t i = 0; i < count; ++i) nodes[i] = &binary_[children[i].first];
  WideLightBVHNode encoded;
  const float strongest = encoded.encode({nodes.data(), count}, leastExtent_);
  if (task.subtree.first == 0) out_.strongest_ = strongest;
  const bool inCluster = task.inCluster || isCluster(piece, task.subtree);
  if (inCluster) {
    encoded.clusterLights = task.subtree.lights() & 0x7fffffff;
    encoded.even = isEven(piece, task.subtree);
    if (!task.inCluster && !encoded.even) piece.clusters.push_back(task.node);
  }
  encoded.firstLight = static_cast<uint32_t>(piece.lights.size());
  encoded.firstChild = static_cast<uint32_t>(piece.nodes.size());
  piece.nodes[task.node] = encoded;
  piece.depth = std::max(piece.depth, task.depth);
  for (size_t i = 0; i < count; ++i) {
    if (nodes[i]->isLeaf()) {
      piece.lights.push_back(nodes[i]->light());
      piece.intensities.push_back(nodes[i]->intensity());
    } else {
      const auto child = static_cast<uint32_t>(piece.nodes.size());
      piece.pending.push_back({children[i], child, task.depth + 1, inCluster});
      piece.nodes.emplace_back();
      piece.parents.push_back(task.node * static_cast<uint32_t>(kWidth) + static_cast<uint32_t>(i));
    }
  }
}

void WideLightBVHBuilder::addIntensities(Piece& piece) {
  piece.intensitiesBefore.resize(piece.lights.size() + 1);
  for (const uint32_t cluster : piece.clusters) {
    const WideLightBVHNode& node = piece.nodes[cluster];
    const float* const intensity = piece.intensities.data() + node.firstLight;
    const double total = std::accumulate(intensity, intensity + node.clusterLights, 0.);
    const double shared = WideLightBVH::kWhole - node.clusterLights;
    double before = 0;
    for (uint32_t k = 0; k < node.clusterLights; ++k) {
      piece.intensitiesBefore[node.firstLight + k] =
          static_cast<uint16_t>(k + shared * (before / total));
      before += static_cast<double>(intensity[k]);
    }
  }
  for (WideLightBVHNode& node : piece.nodes) {
    if (node.even) continue;
    const uint32_t next = piece.intensitiesBefore[node.firstLight + node.clusterLights];
    const uint32_t units =
        (next > 0 ? next : WideLightBVH::kWhole) - piece.intensitiesBefore[node.firstLight];
    if (units < kUnitsPerLight * node.clusterLights) node.clusterLights = 0;
  }
}

void WideLightBVHBuilder::place(const Piece& piece, const Place& at) const {
  constexpr auto kLanes = static_cast<uint32_t>(kWidth);
  const auto numberOf = [&](uint32_t node) {
    return node == 0 ? at.root : at.firstNode + node - 1;
  };
  std::copy(piece.lights.begin(), piece.lights.end(), out_.lights_.begin() + at.firstLight);
  if (hasClusters_)
    std::copy(piece.intensitiesBefore.begin(), piece.intensitiesBefore.end() - 1,
              out_.intensitiesBefore_.begin() + at.firstLight);
  for (uint32_t i = 0; i < piece.nodes.size(); ++i) {
    WideLightBVHNode& node = out_.nodes_[numberOf(i)];
    node = piece.nodes[i];
    const uint32_t parent = piece.parents[i];
    out_.parents_[numberOf(i)] =
        i > 0 ? numberOf(parent / kLanes) * kLanes + parent % kLanes : parent;
    node.firstChild = numberOf(node.firstChild);
    node.firstLight += at.firstLight;
    for (uint32_t lane = 0; lane < kLanes; ++lane)
      if (node.isLeaf(lane))
        out_.slotOf_[out_.lights_[node.light(lane)]] = numberOf(i) * kLanes + lane;
  }
}

}  // namespace lampyris
