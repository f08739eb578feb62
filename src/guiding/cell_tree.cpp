// SPDX-License-Identifier: Apache-2.0
#include "guiding/cell_tree.h"

#include <cmath>

namespace lampyris {

namespace {

/// A cell that has seen this many samples, in terms of samples of equal weight, is divided: its
/// parts still see enough to fit lobes to.
constexpr double kDivideAt = 150;
/// Photons that a cell is divided at, that a part gets at least, and how many it is fitted to at
/// most.
constexpr size_t kDivideSeedAt = 100, kLeastSeed = 15, kFittedSeed = 300;
/// A photon is light that has come, as few of a path's samples find it, and so tells more than one.
constexpr float kCountOfPhoton = 20;
/// A surface passes about four of the eight parts.
constexpr double kPartsOnSurface = 4, kPartOfParent = 1 / kPartsOnSurface;
/// Parts with photons of their own need less.
constexpr double kPartOfSeededParent = 0.1;

}  // namespace

CellTree::CellTree(int recordsPerCell) { addNode(RecordCell(recordsPerCell)); }

size_t CellTree::addNode(RecordCell cell) {
  Node& n = nodes_.emplace_back(Node{std::move(cell), false, {}});
  n.children.fill(kNoChild);
  return nodes_.size() - 1;
}

void CellTree::learn(const PlacedSample& sample, size_t quota) {
  size_t at = 0;
  for (int depth = 0; nodes_[at].divided; ++depth) {
    const size_t child = sample.place.child(depth);
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
  inserted_ += nodes_[at].cell.learn(sample.sample, inserted_ < quota);
}

struct CellTree::SeededCell {
  size_t node = 0;
  int depth = 0;
  std::vector<PlacedSample> photons;
};

/// Level by level, so that parts start from what the whole has learned.
void CellTree::seed(std::vector<PlacedSample>& photons, float size, size_t quota) {
  std::vector<SeededCell> cells;
  cells.emplace_back().photons = std::move(photons);
  for (size_t i = 0; i < cells.size(); ++i) {
    const SeededCell at = std::move(cells[i]);
    const float width = std::ldexp(size, -at.depth);
    const float perArea = static_cast<float>(at.photons.size()) / (width * width);
    RecordCell& cell = nodes_[at.node].cell;
    cell.forgetNothing();
    const size_t step = 1 + at.photons.size() / kFittedSeed;
    for (size_t k = 0; k < at.photons.size(); k += step) {
      GuideSample s = at.photons[k].sample;
      s.radiance *= perArea;
      s.count = kCountOfPhoton;
      inserted_ += cell.learn(s, inserted_ < quota);
    }
    cell.endPass();
    if (at.photons.size() < kDivideSeedAt || at.depth >= CellPlace::kDeepest) continue;
    std::array<SeededCell, 8> parts;
    std::array<double, 8> powers{};  // of the parts' photons, per cosine
    double power = 0;
    for (const PlacedSample& s : at.photons) {
      const size_t child = s.place.child(at.depth);
      SeededCell& part = parts[child];
      part.depth = at.depth + 1;
      part.photons.push_back(s);
      powers[child] += static_cast<double>(s.sample.radiance);
      power += static_cast<double>(s.sample.radiance);
    }
    for (size_t child = 0; child < 8; ++child) {
      const size_t copied = nodes_[at.node].cell.records().size();
      if (parts[child].photons.size() < kLeastSeed || inserted_ + copied > quota) continue;
      inserted_ += copied;
      nodes_[at.node].divided = true;
      parts[child].node = addNode(RecordCell(nodes_[at.node].cell, kPartOfSeededParent,
                                             kPartsOnSurface * powers[child] / power));
      nodes_[at.node].children[child] = static_cast<int32_t>(parts[child].node);
      cells.push_back(std::move(parts[child]));
    }
  }
}

void CellTree::endPass() {
  inserted_ = 0;
  std::vector<int> depth(nodes_.size());
  for (size_t i = 0; i < nodes_.size(); ++i) {  // parents come before their children
    Node& n = nodes_[i];
    n.cell.endPass();
    if (n.cell.effectiveSamples() > kDivideAt && depth[i] < CellPlace::kDeepest) n.divided = true;
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
