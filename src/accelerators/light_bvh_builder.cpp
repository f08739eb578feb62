// SPDX-License-Identifier: Apache-2.0
#include "accelerators/light_bvh_builder.h"

#include <algorithm>
#include <array>
#include <numeric>

#include "accelerators/light_bvh.h"
#include "accelerators/light_bvh_cost.h"
#include "core/parallel.h"
#include "core/prefetch.h"

namespace lampyris {
namespace {

constexpr int kMaxBuckets = 16;
constexpr uint32_t kMaxSplitDepth = 64;
constexpr size_t kParallelGrain = 4096;
/// Inputs that one thread collects at a time.
constexpr size_t kCollectGrain = 16384;
/// Subtrees of this many lights fetch the inputs of their leaves ahead: by then they lie scattered
/// over memory, and waiting for them would be half of the build's time.
constexpr size_t kPrefetch = 32;

/// Positive and finite.
float toFloat(double v) { return static_cast<float>(std::clamp(v, 1e-37, 3e38)); }

/// What a finished subtree passes up.
struct Subtree {
  Bounds3 box;
  EmissionCone cone;
  double flux = 0;  ///< in 4π W: the mean intensity over all directions
  uint32_t depth = 1;
};

class Builder {
 public:
  Builder(std::span<const LightBVHInput> inputs, HugeVector<LinearLightBVHNode>& nodes,
          std::vector<uint32_t>& leafOf)
      : inputs_(inputs), nodes_(nodes), leafOf_(leafOf) {}

  uint32_t build() {
    const Range centroids = collect();
    if (lights_.empty()) return 0;
    nodes_.resize(2 * lights_.size() - 1);
    return build(0, lights_.size(), 0, 0, centroids).depth;
  }

 private:
  struct Split {
    int axis = -1;   ///< none
    int bucket = 0;  ///< the last one on the left
  };
  /// Maps twice a centroid to bucket numbers.
  struct Grid {
    Float4 origin, scale;
    int buckets;
    Int4 operator()(const BuildLight& l) const {
      const Int4 k = __builtin_convertvector((l.twiceCentroid() - origin) * scale, Int4);
      const Int4 zero{}, top = zero + (buckets - 1);
      const Int4 raised = k < zero ? zero : k;
      return raised > top ? top : raised;
    }
    /// The same for one axis.
    int along(int axis, const BuildLight& l) const {
      const float at = (l.lo[axis] + l.hi[axis] - origin[axis]) * scale[axis];
      return std::clamp(static_cast<int>(at), 0, buckets - 1);
    }
  };

  /// The two halves of a range of lights.
  struct Halves {
    size_t middle;
    Range left, right;
  };

  Range collect();
  Subtree build(size_t first, size_t last, uint32_t node, uint32_t depth, const Range& centroids);
  Subtree makeLeaf(size_t i, uint32_t node);
  Subtree join(const Subtree& left, const Subtree& right, uint32_t node, uint32_t rightNode);
  void prefetchInputs(size_t first, size_t last) const;
  Halves partition(size_t first, size_t last, uint32_t depth, const Range& centroids);
  Halves halve(size_t first, size_t last) const;
  Split bestSplit(size_t first, size_t last, const Grid& grid) const;

  std::span<const LightBVHInput> inputs_;
  HugeVector<LinearLightBVHNode>& nodes_;
  std::vector<uint32_t>& leafOf_;
  HugeVector<BuildLight> lights_;
};

/// The lights that are in the tree, in the order of the inputs.
Range Builder::collect() {
  const size_t chunks = (inputs_.size() + kCollectGrain - 1) / kCollectGrain;
  const auto forEachOf = [&](size_t chunk, const auto& body) {
    const size_t end = std::min(inputs_.size(), (chunk + 1) * kCollectGrain);
    for (size_t i = chunk * kCollectGrain; i < end; ++i)
      if (usable(inputs_[i].bounds)) body(i);
  };
  const auto forChunks = [&](const auto& body) {
    parallelFor(chunks, 1, [&](size_t begin, size_t end) {
      for (size_t chunk = begin; chunk < end; ++chunk) body(chunk);
    });
  };
  std::vector<size_t> firstOf(chunks + 1, 0);
  forChunks([&](size_t chunk) { forEachOf(chunk, [&](size_t) { ++firstOf[chunk + 1]; }); });
  std::partial_sum(firstOf.begin(), firstOf.end(), firstOf.begin());
  lights_.resize(firstOf.back());
  std::vector<Range> ranges(chunks);
  forChunks([&](size_t chunk) {
    size_t at = firstOf[chunk];
    forEachOf(chunk, [&](size_t i) {
      lights_[at] = BuildLight(inputs_[i].bounds, static_cast<uint32_t>(i));
      ranges[chunk].add(lights_[at++].twiceCentroid());
    });
  });
  Range all;
  for (const Range& r : ranges) all.add(r);
  return all;
}

Subtree Builder::makeLeaf(size_t i, uint32_t node) {
  const LightBVHInput& input = inputs_[lights_[i].index()];
  Subtree s{input.bounds.box, EmissionCone::of(input.bounds)};
  const double intensity = static_cast<double>(input.bounds.intensity) / s.cone.peakFactor();
  s.flux = intensity * s.cone.meanFactor();
  std::construct_at(&nodes_[node], s.box, s.cone, toFloat(intensity), true, input.id);
  leafOf_[input.id] = node;
  return s;
}

void Builder::prefetchInputs(size_t first, size_t last) const {
  for (size_t i = first; i < last; ++i) {
    const char* input = reinterpret_cast<const char*>(&inputs_[lights_[i].index()]);
    prefetchLine(input);
    prefetchLine(input + sizeof(LightBVHInput) - 1);
  }
}

Subtree Builder::build(size_t first, size_t last, uint32_t node, uint32_t depth,
                       const Range& centroids) {
  const size_t count = last - first;
  if (count == 1) return makeLeaf(first, node);
  if (count > kPrefetch / 4 && count <= kPrefetch) prefetchInputs(first, last);
  const Halves halves =
      count == 2 ? Halves{first + 1, {}, {}} : partition(first, last, depth, centroids);
  const size_t middle = halves.middle;
  const uint32_t right = node + 2 * static_cast<uint32_t>(middle - first);
  const auto buildLeft = [&] { return build(first, middle, node + 1, depth + 1, halves.left); };
  const auto buildRight = [&] { return build(middle, last, right, depth + 1, halves.right); };
  if (count <= kParallelGrain) return join(buildLeft(), buildRight(), node, right);
  Subtree l, r;
  parallelInvoke([&] { l = buildLeft(); }, [&] { r = buildRight(); });
  return join(l, r, node, right);
}

Subtree Builder::join(const Subtree& l, const Subtree& r, uint32_t node, uint32_t rightNode) {
  Subtree s{l.box, merge(l.cone, r.cone), l.flux + r.flux, 1 + std::max(l.depth, r.depth)};
  s.box.extend(r.box);
  const float intensity = toFloat(s.flux / s.cone.meanFactor());
  std::construct_at(&nodes_[node], s.box, s.cone, intensity, false, rightNode);
  return s;
}

Builder::Halves Builder::halve(size_t first, size_t last) const {
  Halves halves{first + (last - first) / 2, {}, {}};
  for (size_t i = first; i < last; ++i)
    (i < halves.middle ? halves.left : halves.right).add(lights_[i].twiceCentroid());
  return halves;
}

Builder::Halves Builder::partition(size_t first, size_t last, uint32_t depth,
                                   const Range& centroids) {
  if (depth >= kMaxSplitDepth) return halve(first, last);
  const size_t count = last - first;
  Grid grid{centroids.lo, splat(0), count <= 8 ? 4 : (count <= 64 ? 8 : kMaxBuckets)};
  for (int a = 0; a < 3; ++a) {
    // A little less than the number of buckets, so that the last light stays in the last one.
    const float scale =
        static_cast<float>(grid.buckets) * 0.99999f / (centroids.hi[a] - centroids.lo[a]);
    grid.scale[a] = std::isfinite(scale) ? scale : 0;
  }
  const Split split = bestSplit(first, last, grid);
  if (split.axis < 0) return halve(first, last);
  // Without branches, which would be mispredicted half of the time.
  Halves halves{first, {}, {}};
  for (size_t i = first; i < last; ++i) {
    const BuildLight l = lights_[i];
    lights_[i] = lights_[halves.middle];
    lights_[halves.middle] = l;
    const bool left = grid.along(split.axis, l) <= split.bucket;
    halves.middle += static_cast<size_t>(left);
    const Int4 mask = Int4{} - static_cast<int>(left);
    halves.left.addIf(mask, l.twiceCentroid());
    halves.right.addIf(~mask, l.twiceCentroid());
  }
  const bool any = halves.middle > first && halves.middle < last;
  return any ? halves : halve(first, last);
}

Builder::Split Builder::bestSplit(size_t first, size_t last, const Grid& grid) const {
  std::array<std::array<Bucket, kMaxBuckets>, 3> buckets;
  for (auto& axis : buckets) std::fill_n(axis.begin(), grid.buckets, Bucket());
  const int top = grid.buckets - 1;
  for (size_t i = first; i < last; ++i) {
    const Int4 k = grid(lights_[i]);
    for (int a = 0; a < 3; ++a)
      buckets[static_cast<size_t>(a)][static_cast<size_t>(k[a])].add(lights_[i]);
  }
  Bucket all;
  for (int i = 0; i <= top; ++i) all.add(buckets[0][static_cast<size_t>(i)]);
  const Float4 extent = all.hi - all.lo;
  const float size = std::max(extent[0], std::max(extent[1], extent[2]));
  const float invSize = 1 / size;
  if (!(size > 0) || !std::isfinite(invSize)) return {};

  Split best;
  float bestCost = kInfinity;
  for (int a = 0; a < 3; ++a) {
    if (!(grid.scale[a] > 0) || !(extent[a] > 0)) continue;
    const auto& row = buckets[static_cast<size_t>(a)];
    std::array<float, kMaxBuckets> rightCost{};
    Bucket sum;
    for (int i = top; i > 0; --i) {
      const auto k = static_cast<size_t>(i);
      if (i < top && row[k].empty()) {
        rightCost[k] = rightCost[k + 1];
        continue;
      }
      sum.add(row[k]);
      rightCost[k] = clusterCost(sum, invSize);
    }
    // Conty and Kulla 2018: thin splits are worth less.
    const float regularisation = size / extent[a];
    sum = Bucket();
    for (int i = 0; i < top; ++i) {
      if (row[static_cast<size_t>(i)].empty()) continue;
      sum.add(row[static_cast<size_t>(i)]);
      if (!(rightCost[static_cast<size_t>(i) + 1] >= 0)) continue;
      const float cost =
          regularisation * (clusterCost(sum, invSize) + rightCost[static_cast<size_t>(i) + 1]);
      if (cost < bestCost) bestCost = cost, best = {a, i};
    }
  }
  return best;
}

}  // namespace

uint32_t buildLightBVH(std::span<const LightBVHInput> lights, HugeVector<LinearLightBVHNode>& nodes,
                       std::vector<uint32_t>& leafOf) {
  return Builder(lights, nodes, leafOf).build();
}

}  // namespace lampyris
