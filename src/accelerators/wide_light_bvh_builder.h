// SPDX-License-Identifier: Apache-2.0
/// Collapses the binary light BVH into the wide one.
#pragma once

#include "accelerators/wide_light_bvh.h"

namespace lampyris {

/// Takes subtrees as children so that nodes are full at the bottom (few bytes a light) and alike in
/// size at the top (few levels). Below the top, pieces of the tree are collapsed in parallel, each
/// into nodes of its own, and then put side by side: the tree doesn't depend on the number of
/// threads.
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
  /// Of intensities.
  struct Range {
    float least, most;
  };
  /// An inner node still to be filled in.
  struct Task {
    Subtree subtree;
    uint32_t node, depth;
    bool inCluster = false;
  };
  /// A part of the wide tree. Its numbers are its own until place().
  struct Piece {
    std::vector<WideLightBVHNode> nodes;  ///< the root first
    std::vector<uint32_t> parents;        ///< per node; the root's is that of the top
    std::vector<LightId> lights;
    std::vector<float> intensities;           ///< per light
    std::vector<Range> ranges;                ///< per node of the binary tree below the root
    uint32_t firstRange = 0;                  ///< the root there
    std::vector<uint16_t> intensitiesBefore;  ///< per light; none if the tree has no clusters
    std::vector<uint32_t> clusters;           ///< the largest uneven ones: numbers of nodes
    std::vector<Task> pending;
    uint32_t depth = 0;  ///< levels above and within
  };
  /// Where a piece goes: its root has a place among the nodes of the top, the others follow.
  struct Place {
    uint32_t root, firstNode, firstLight;
  };

  size_t chooseChildren(const Subtree& root, Children& children) const;
  /// Prepares to collapse the subtree into the piece, whose root's parent is given.
  void start(Piece& piece, const Task& root, uint32_t parent) const;
  static bool isEven(const Piece& piece, const Subtree& subtree);
  bool isCluster(const Piece& piece, const Subtree& subtree) const;
  void open(Children& children, size_t& count, size_t which) const;
  /// Fills in the pending nodes, and puts those of at most `leave` lights aside.
  void collapse(Piece& piece, uint32_t leave, std::vector<Task>& aside) const;
  void fill(const Task& task, Piece& piece) const;
  /// The units of the clusters' lights; clusters of which that says too little are none.
  static void addIntensities(Piece& piece);
  void place(const Piece& piece, const Place& at) const;

  const HugeVector<LinearLightBVHNode>& binary_;
  WideLightBVH& out_;
  float leastExtent_;
  bool hasClusters_ = false;
};

}  // namespace lampyris
