// SPDX-License-Identifier: Apache-2.0
/// An octree of record cells: fine where many paths come by.
#pragma once

#include <array>
#include <vector>

#include "guiding/record_cell.h"

namespace lampyris {

/// Where a point lies in an octree of cells: which child at each depth.
class CellPlace {
 public:
  /// How often a cell is halved at most.
  static constexpr int kDeepest = 6;

  /// In the smallest cells.
  static constexpr int kCellsAcross = 1 << kDeepest;

  CellPlace() = default;
  /// In the undivided cell, in smallest cells: from 0 to kCellsAcross - 1.
  CellPlace(uint32_t x, uint32_t y, uint32_t z)
      : bits_(spread(x) | spread(y) << 1 | spread(z) << 2) {}
  /// 0 ≤ `depth` < kDeepest; from 0 to 7.
  size_t child(int depth) const { return bits_ >> 3 * (kDeepest - 1 - depth) & 7; }
  /// Of the child at an even depth, which of its children: from 0 to 63, the child's number first.
  size_t grandchild(int depth) const { return bits_ >> 3 * (kDeepest - 2 - depth) & 63; }

 private:
  /// Three places for each bit.
  static uint32_t spread(uint32_t x) {
    static_assert(kDeepest <= 8);
    x = (x | x << 8) & 0x00f00f;
    x = (x | x << 4) & 0x0c30c3;
    return (x | x << 2) & 0x249249;
  }

  uint32_t bits_ = 0;
};

struct PlacedSample {
  GuideSample sample;
  CellPlace place;
};

class CellTree {
 public:
  static constexpr int32_t kNoChild = -1;
  using Children = std::array<int32_t, 8>;

  explicit CellTree(int recordsPerCell);

  /// Counts a sample within the root. Makes at most `quota` records in all until endPass().
  void learn(const PlacedSample& sample, size_t quota);
  /// Starts from photons, whose `radiance` is power per cosine; `size` is the root's.
  void seed(std::vector<PlacedSample>& photons, float size, size_t quota);
  /// Fits the cells; those that have seen enough will be divided.
  void endPass();

  struct Node {
    RecordCell cell;
    bool divided = false;
    Children children;
  };
  const std::vector<Node>& nodes() const { return nodes_; }
  size_t recordCount() const;
  size_t memory() const;

  /// Of an equal tree, between passes.
  void save(ByteWriter& out) const;
  void restore(ByteReader& in);

 private:
  struct SeededCell;
  size_t addNode(RecordCell cell);

  std::vector<Node> nodes_;
  size_t inserted_ = 0;
};

}  // namespace lampyris
