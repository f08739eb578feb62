// SPDX-License-Identifier: Apache-2.0
/// An octree of record cells: fine where many paths come by.
#pragma once

#include <array>
#include <vector>

#include "guiding/record_cell.h"

namespace lampyris {

class CellTree {
 public:
  /// How often a cell is halved at most.
  static constexpr int kDeepest = 6;
  static constexpr int32_t kNoChild = -1;
  using Children = std::array<int32_t, 8>;

  CellTree(const Vec3& centre, float size, int recordsPerCell);

  /// Counts a sample within the root. Makes at most `quota` records in all until endPass().
  void learn(const GuideSample& sample, size_t quota);
  /// Starts from photons, whose `radiance` is power per cosine.
  void seed(std::vector<GuideSample>& photons, size_t quota);
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

  /// Which child `p` lies in, and that child's centre and size in place of the parent's.
  static int descend(const Vec3& p, Vec3& centre, float& size);

 private:
  struct SeededCell;
  size_t addNode(RecordCell cell);

  Vec3 centre_;
  float size_;
  std::vector<Node> nodes_;
  size_t inserted_ = 0;
};

}  // namespace lampyris
