// SPDX-License-Identifier: Apache-2.0
#include "guiding/cell_tree.h"

namespace lampyris {

namespace {

/// A cell that has seen this many samples, in terms of samples of equal weight, is divided: its
/// parts still see enough to fit lobes to.
constexpr double kDivideAt = 150;
/// A surface passes about four of the eight parts.
constexpr double kPartOfParent = 0.25;

}  // namespace

CellTree::CellTree(const Vec3& centre, float size, int recordsPerCell)
    : centre_(centre), size_(size) {
  addNode(RecordCell(recordsPerCell));
}

size_t CellTree::addNode(RecordCell cell) {
  Node& n = nodes_.emplace_back(Node{std::move(cell), false, {}});
  n.children.fill(kNoChild);
  return nodes_.size() - 1;
}

int CellTree::descend(const Vec3& p, Vec3& centre, float& size) {
  size *= 0.5f;
  int child = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const bool upper = p[axis] >= centre[axis];
    child |= upper << axis;
    centre[axis] += (upper ? 0.5f : -0.5f) * size;
  }
  return child;
}

void CellTree::learn(const GuideSample& sample, size_t quota) {
  Vec3 centre = centre_;
  float size = size_;
  size_t at = 0;
  while (nodes_[at].divided) {
    const auto child = static_cast<size_t>(descend(sample.p, centre, size));
    int32_t next = nodes_[at].children[child];
    if (next == kNoChild) {
      const size_t copied = nodes_[at].cell.records().size();
      if (inserted_ + copied > quota) break;
      inserted_ += copied;
      next = static_cast<int32_t>(addNode(RecordCell(nodes_[at].cell, kPartOfParent)));
      nodes_[at].children[child] = next;
    }
    at = static_cast<size_t>(next);
  }
  inserted_ += nodes_[at].cell.learn(sample, inserted_ < quota);
}

void CellTree::endPass() {
  inserted_ = 0;
  std::vector<int> depth(nodes_.size());
  for (size_t i = 0; i < nodes_.size(); ++i) {  // parents come before their children
    Node& n = nodes_[i];
    n.cell.endPass();
    if (n.cell.effectiveSamples() > kDivideAt && depth[i] < kDeepest) n.divided = true;
    for (const int32_t child : n.children)
      if (child != kNoChild) depth[static_cast<size_t>(child)] = depth[i] + 1;
  }
}

void CellTree::save(ByteWriter& out) const {
  out.put(nodes_.size());
  for (const Node& n : nodes_) {
    n.cell.save(out);
    out.put(n.divided);
    out.put(n.children);
  }
}

void CellTree::restore(ByteReader& in) {
  nodes_.assign(in.getCount(sizeof(Children)), {RecordCell(0), false, {}});
  for (Node& n : nodes_) {
    n.cell.restore(in);
    in.get(n.divided);
    in.get(n.children);
  }
}

size_t CellTree::recordCount() const {
  size_t count = 0;
  for (const Node& n : nodes_) count += n.cell.records().size();
  return count;
}

size_t CellTree::memory() const {
  size_t bytes = sizeof *this + nodes_.capacity() * sizeof(Node);
  for (const Node& n : nodes_) bytes += n.cell.records().capacity() * sizeof(SignificanceRecord);
  return bytes;
}

}  // namespace lampyris
