// SPDX-License-Identifier: Apache-2.0
#include "accelerators/light_bvh_builder.h"

#include <algorithm>
#include <array>

#include "accelerators/light_bvh.h"
#include "core/parallel.h"

namespace lampyris {
namespace {

// Four floats in a register. Written with the compiler's vectors since the build is bound by these
// few minima, maxima and sums.
using Float4 = float __attribute__((vector_size(16)));
using Int4 = int32_t __attribute__((vector_size(16)));
inline Float4 min4(Float4 a, Float4 b) { return a < b ? a : b; }
inline Float4 max4(Float4 a, Float4 b) { return a > b ? a : b; }
inline Float4 splat(float v) { return Float4{v, v, v, v}; }

constexpr int kMaxBuckets = 16;
constexpr uint32_t kMaxSplitDepth = 64;
constexpr size_t kParallelGrain = 4096;
/// Subtrees of this many lights fetch the inputs of their leaves ahead: by then they lie scattered
/// over memory, and waiting for them would be half of the build's time.
constexpr size_t kPrefetch = 32;

/// A light while the tree is built.
struct BuildLight {
  Float4 lo;      ///< of the box; last: cos θe
  Float4 hi;      ///< of the box; last: `index` in its bits, made a normal float by kIndexBit
  Float4 spread;  ///< intensity × axis × how far normals agree; last: intensity
  static constexpr uint32_t kIndexBit = 0x40000000;

  uint32_t index() const { return std::bit_cast<uint32_t>(hi[3]) & ~kIndexBit; }
  Float4 twiceCentroid() const { return lo + hi; }
};

struct Bucket {
  Float4 lo = splat(kInfinity), hi = splat(-kInfinity), spread = splat(0);

  void add(const BuildLight& l) { lo = min4(lo, l.lo), hi = max4(hi, l.hi), spread += l.spread; }
  void add(const Bucket& b) { lo = min4(lo, b.lo), hi = max4(hi, b.hi), spread += b.spread; }
};

/// acos to 7e-5 (Abramowitz and Stegun 1964, 4.4.45): enough to compare splits.
float fastAcos(float x) {
  const float a = std::min(std::abs(x), 1.f);
  const float v =
      std::sqrt(1 - a) * (1.5707288f + a * (-0.2121144f + a * (0.0742610f - a * 0.0187293f)));
  return x < 0 ? kPi - v : v;
}

/// Ma 2018, eq. 3.3: the measure of the directions that a cone emits to.
float coneMeasure(float cosO, float cosE) {
  if (cosO < -0.999f) return 4 * kPi;
  const float thetaO = fastAcos(cosO), sinO = std::sqrt(std::max(0.f, 1 - cosO * cosO));
  float falloff = fastAcos(cosE);  // θw − θo
  float cosFalloff = cosE;
  if (thetaO + falloff > kPi) falloff = kPi - thetaO, cosFalloff = -cosO;
  // cos(2θw − θo) from cos and sin of θo and 2 (θw − θo).
  const float sinFalloff = std::sqrt(std::max(0.f, 1 - cosFalloff * cosFalloff));
  const float cos2 = 2 * cosFalloff * cosFalloff - 1, sin2 = 2 * sinFalloff * cosFalloff;
  const float cosSum = cosO * cos2 - sinO * sin2;
  return 2 * kPi * (1 - cosO) + kPi / 2 * (cosO - cosSum + 2 * falloff * sinO);
}

/// Ma 2018, eq. 3.1, in units of `invSize`.
float clusterCost(const Bucket& b, float invSize) {
  const Float4 e = (b.hi - b.lo) * splat(invSize), s = b.spread;
  const float area =
      2 * (e[0] * e[1] + e[1] * e[2] + e[2] * e[0]) + e[0] * e[0] + e[1] * e[1] + e[2] * e[2];
  if (!(s[3] > 0) || !(area > 0)) return 0;
  // Normals spread evenly over a cap of angle θo have a mean of length (1 + cos θo) / 2.
  const float mean = std::sqrt(s[0] * s[0] + s[1] * s[1] + s[2] * s[2]) / s[3];
  return s[3] * area * coneMeasure(std::min(2 * mean - 1, 1.f), b.lo[3]);
}

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
  Builder(std::span<const LightBVHInput> inputs, std::vector<LinearLightBVHNode>& nodes,
          std::vector<uint32_t>& leafOf)
      : inputs_(inputs), nodes_(nodes), leafOf_(leafOf) {}

  uint32_t build() {
    collect();
    if (lights_.empty()) return 0;
    nodes_.resize(2 * lights_.size() - 1);
    return build(0, lights_.size(), 0, 0).depth;
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

  void collect();
  Subtree build(size_t first, size_t last, uint32_t node, uint32_t depth);
  Subtree makeLeaf(size_t i, uint32_t node);
  void prefetchInputs(size_t first, size_t last) const;
  size_t partition(size_t first, size_t last, uint32_t depth);
  Split bestSplit(size_t first, size_t last, const Grid& grid, const Bucket& all) const;

  std::span<const LightBVHInput> inputs_;
  std::vector<LinearLightBVHNode>& nodes_;
  std::vector<uint32_t>& leafOf_;
  std::vector<BuildLight> lights_;
};

void Builder::collect() {
  lights_.reserve(inputs_.size());
  for (uint32_t i = 0; i < inputs_.size(); ++i) {
    const LightBounds& b = inputs_[i].bounds;
    if (!(b.intensity > 0) || !std::isfinite(b.intensity)) continue;
    if (b.box.empty() || !isFinite(b.box.min) || !isFinite(b.box.max)) continue;
    Vec3 axis = normalize(b.axis);
    if (b.twoSided) {  // a cone and its opposite count alike
      const float x = std::abs(axis.x), y = std::abs(axis.y), z = std::abs(axis.z);
      const float largest = x >= y && x >= z ? axis.x : (y >= z ? axis.y : axis.z);
      if (largest < 0) axis = -axis;
    }
    axis *= b.intensity * 0.5f * (1 + std::clamp(b.cosThetaO, -1.f, 1.f));
    BuildLight l;
    l.lo = Float4{b.box.min.x, b.box.min.y, b.box.min.z, std::clamp(b.cosThetaE, -1.f, 1.f)};
    l.hi = Float4{b.box.max.x, b.box.max.y, b.box.max.z,
                  std::bit_cast<float>(i | BuildLight::kIndexBit)};
    l.spread = Float4{axis.x, axis.y, axis.z, b.intensity};
    lights_.push_back(l);
  }
}

Subtree Builder::makeLeaf(size_t i, uint32_t node) {
  const LightBVHInput& input = inputs_[lights_[i].index()];
  Subtree s;
  s.box = input.bounds.box;
  s.cone = EmissionCone::of(input.bounds);
  const double intensity = static_cast<double>(input.bounds.intensity) / s.cone.peakFactor();
  s.flux = intensity * s.cone.meanFactor();
  nodes_[node] = LinearLightBVHNode(s.box, s.cone, toFloat(intensity), true, input.id);
  leafOf_[input.id] = node;
  return s;
}

void Builder::prefetchInputs(size_t first, size_t last) const {
  for (size_t i = first; i < last; ++i) {
    const char* input = reinterpret_cast<const char*>(&inputs_[lights_[i].index()]);
    __builtin_prefetch(input);
    __builtin_prefetch(input + sizeof(LightBVHInput) - 1);
  }
}

Subtree Builder::build(size_t first, size_t last, uint32_t node, uint32_t depth) {
  const size_t count = last - first;
  if (count == 1) return makeLeaf(first, node);
  if (count > kPrefetch / 4 && count <= kPrefetch) prefetchInputs(first, last);
  const size_t middle = count == 2 ? first + 1 : partition(first, last, depth);
  const uint32_t right = node + 2 * static_cast<uint32_t>(middle - first);
  Subtree l, r;
  const auto buildLeft = [&] { l = build(first, middle, node + 1, depth + 1); };
  const auto buildRight = [&] { r = build(middle, last, right, depth + 1); };
  if (count > kParallelGrain) {
    parallelInvoke(buildLeft, buildRight);
  } else {
    buildLeft();
    buildRight();
  }
  Subtree s;
  s.box = l.box;
  s.box.extend(r.box);
  s.cone = merge(l.cone, r.cone);
  s.flux = l.flux + r.flux;
  s.depth = 1 + std::max(l.depth, r.depth);
  const float intensity = toFloat(s.flux / s.cone.meanFactor());
  nodes_[node] = LinearLightBVHNode(s.box, s.cone, intensity, false, right);
  return s;
}

size_t Builder::partition(size_t first, size_t last, uint32_t depth) {
  const size_t middle = first + (last - first) / 2;
  if (depth >= kMaxSplitDepth) return middle;
  Bucket all;
  Float4 lo = splat(kInfinity), hi = splat(-kInfinity);
  for (size_t i = first; i < last; ++i) {
    const Float4 c = lights_[i].twiceCentroid();
    lo = min4(lo, c), hi = max4(hi, c);
    all.add(lights_[i]);
  }
  const size_t count = last - first;
  Grid grid{lo, splat(0), count <= 8 ? 4 : (count <= 64 ? 8 : kMaxBuckets)};
  for (int a = 0; a < 3; ++a) {
    // A little less than the number of buckets, so that the last light stays in the last one.
    const float scale = static_cast<float>(grid.buckets) * 0.99999f / (hi[a] - lo[a]);
    grid.scale[a] = std::isfinite(scale) ? scale : 0;
  }
  const Split split = bestSplit(first, last, grid, all);
  if (split.axis < 0) return middle;
  // Without branches, which would be mispredicted half of the time.
  size_t at = first;
  for (size_t i = first; i < last; ++i) {
    const BuildLight l = lights_[i];
    lights_[i] = lights_[at];
    lights_[at] = l;
    at += static_cast<size_t>(grid.along(split.axis, l) <= split.bucket);
  }
  return at == first || at == last ? middle : at;
}

Builder::Split Builder::bestSplit(size_t first, size_t last, const Grid& grid,
                                  const Bucket& all) const {
  std::array<std::array<Bucket, kMaxBuckets>, 3> buckets;
  for (auto& axis : buckets) std::fill_n(axis.begin(), grid.buckets, Bucket());
  const int top = grid.buckets - 1;
  for (size_t i = first; i < last; ++i) {
    const Int4 k = grid(lights_[i]);
    for (int a = 0; a < 3; ++a)
      buckets[static_cast<size_t>(a)][static_cast<size_t>(k[a])].add(lights_[i]);
  }
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
      sum.add(row[static_cast<size_t>(i)]);
      rightCost[static_cast<size_t>(i)] = clusterCost(sum, invSize);
    }
    // Conty and Kulla 2018: thin splits are worth less.
    const float regularisation = size / extent[a];
    sum = Bucket();
    for (int i = 0; i < top; ++i) {
      sum.add(row[static_cast<size_t>(i)]);
      if (!(sum.spread[3] > 0) || !(rightCost[static_cast<size_t>(i) + 1] >= 0)) continue;
      const float cost =
          regularisation * (clusterCost(sum, invSize) + rightCost[static_cast<size_t>(i) + 1]);
      if (cost < bestCost) bestCost = cost, best = {a, i};
    }
  }
  return best;
}

}  // namespace

uint32_t buildLightBVH(std::span<const LightBVHInput> lights,
                       std::vector<LinearLightBVHNode>& nodes, std::vector<uint32_t>& leafOf) {
  return Builder(lights, nodes, leafOf).build();
}

}  // namespace lampyris
