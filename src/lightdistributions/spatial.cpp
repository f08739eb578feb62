// SPDX-License-Identifier: Apache-2.0
/// Lights by what they contribute to the voxel of a grid that the point lies in: pbrt-v3's
/// "spatial".
///
/// Deviation: pbrt-v3 keeps one number per voxel and light, estimated at random points. Here a
/// voxel keeps at most 64 clusters: nodes of the light BVH, of which the most important for the
/// voxel was replaced by its children again and again; a cluster's lights are chosen by intensity.
/// A cluster's importance takes the whole voxel as its receiver, so that no light that reaches any
/// point of it is missed. Voxels are worked out when first asked for, by whichever thread asks; the
/// result does not depend on it. Cost per sample: O(log lights), independent of the shading normal.
#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <vector>

#include "lightdistributions/light_set.h"

namespace lampyris {
namespace {

constexpr size_t kMaxClusters = 64;
/// Share of lights chosen by intensity alone: for points that rounding puts outside of their voxel.
constexpr double kDefensiveShare = 0.05;

struct SpatialParameters {
  int maxVoxels = 64;
  void declare(Declaration& d) {
    d.add("maxvoxels", maxVoxels, "Number of voxels along the longest edge of the scene.")
        .range(1, 1024);
  }
};

struct Cluster {
  uint32_t node = 0;
  float pmf = 0;
  double importance = 0;
};
/// Clusters by ascending node.
struct Voxel {
  std::vector<Cluster> clusters;
  double infiniteShare = 0;
  bool reached = false;  ///< by any light of the tree
};

class SpatialLightDistribution final : public LightDistribution {
 public:
  SpatialLightDistribution(const SpatialParameters& p, const LightDistributionContext& context);
  ~SpatialLightDistribution() override {
    for (auto& slot : voxels_) delete slot.load(std::memory_order_relaxed);
  }

  std::optional<SampledLight> sample(const LightSampleContext& ctx, float u) const override;
  float pmf(const LightSampleContext& ctx, LightId light) const override;

 private:
  const Voxel& voxelAt(const Vec3& p) const;
  std::unique_ptr<const Voxel> makeVoxel(const std::array<int, 3>& cell) const;
  float clusterPmf(const Voxel& voxel, uint32_t leaf) const;
  /// Lights without a position count alike at all points.
  static LightReceiver everywhere() { return {Vec3(0), 0.f}; }

  LightBVHAccel tree_;
  InfiniteLights infinite_;
  Bounds3 box_;
  std::array<int, 3> counts_{1, 1, 1};
  mutable std::vector<std::atomic<const Voxel*>> voxels_;
};

SpatialLightDistribution::SpatialLightDistribution(const SpatialParameters& p,
                                                   const LightDistributionContext& context)
    : tree_(makeLightTree(context)), infinite_(context.lights), box_(context.sceneBounds) {
  if (box_.empty() || !isFinite(box_.min) || !isFinite(box_.max)) box_ = Bounds3(Vec3(0));
  const Vec3 extent = box_.extent();
  const float longest = maxComponent(extent);
  size_t total = 1;
  for (size_t i = 0; i < 3; ++i) {
    const float cells =
        static_cast<float>(p.maxVoxels) * safeDivide(extent[static_cast<int>(i)], longest);
    counts_[i] = std::clamp(static_cast<int>(std::lround(cells)), 1, p.maxVoxels);
    total *= static_cast<size_t>(counts_[i]);
  }
  // A tree of one light, or none, looks the same from everywhere.
  if (tree_.nodes().size() <= 1) counts_ = {1, 1, 1}, total = 1;
  voxels_ = std::vector<std::atomic<const Voxel*>>(total);
}

const Voxel& SpatialLightDistribution::voxelAt(const Vec3& p) const {
  std::array<int, 3> cell{};
  for (size_t i = 0; i < 3; ++i) {
    const int axis = static_cast<int>(i);
    const float at = safeDivide(p[axis] - box_.min[axis], box_.max[axis] - box_.min[axis]);
    const float scaled = std::clamp(at, 0.f, 1.f) * static_cast<float>(counts_[i]);
    cell[i] = std::min(static_cast<int>(scaled), counts_[i] - 1);
  }
  const size_t index = static_cast<size_t>(
      (static_cast<int64_t>(cell[2]) * counts_[1] + cell[1]) * counts_[0] + cell[0]);
  std::atomic<const Voxel*>& slot = voxels_[index];
  if (const Voxel* ready = slot.load(std::memory_order_acquire)) return *ready;
  auto made = makeVoxel(cell);
  const Voxel* expected = nullptr;
  if (slot.compare_exchange_strong(expected, made.get(), std::memory_order_acq_rel))
    return *made.release();
  return *expected;  // another thread was first, with the same result
}

std::unique_ptr<const Voxel> SpatialLightDistribution::makeVoxel(
    const std::array<int, 3>& cell) const {
  auto voxel = std::make_unique<Voxel>();
  const double elsewhere = infinite_.irradiance(everywhere());
  if (tree_.empty()) {
    voxel->infiniteShare = infiniteShare(elsewhere, 0);
    return voxel;
  }
  Vec3 center(0), edge(0);
  for (size_t i = 0; i < 3; ++i) {
    const int axis = static_cast<int>(i);
    edge[axis] = (box_.max[axis] - box_.min[axis]) / static_cast<float>(counts_[i]);
    center[axis] = box_.min[axis] + (static_cast<float>(cell[i]) + 0.5f) * edge[axis];
  }
  const LightReceiver at(center, 0.5f * length(edge));
  const auto& nodes = tree_.nodes();
  const auto importance = [&](uint32_t node) { return at.importance(nodes[node]); };

  std::vector<Cluster>& cut = voxel->clusters;
  cut.push_back({0, 0, importance(0)});
  while (cut.size() < kMaxClusters) {
    Cluster* largest = nullptr;
    for (Cluster& c : cut)
      if (!nodes[c.node].isLeaf() && c.importance > 0 &&
          (!largest || c.importance > largest->importance))
        largest = &c;
    if (!largest) break;
    const uint32_t parent = largest->node, right = nodes[parent].rightChild();
    *largest = {parent + 1, 0, importance(parent + 1)};
    cut.push_back({right, 0, importance(right)});
  }
  std::sort(cut.begin(), cut.end(),
            [](const Cluster& a, const Cluster& b) { return a.node < b.node; });
  double total = 0;
  for (const Cluster& c : cut) total += c.importance;
  for (Cluster& c : cut) c.pmf = total > 0 ? static_cast<float>(c.importance / total) : 0;
  voxel->reached = total > 0;
  voxel->infiniteShare = infiniteShare(elsewhere, std::max(total, 1e-300));
  return voxel;
}

float SpatialLightDistribution::clusterPmf(const Voxel& voxel, uint32_t leaf) const {
  const auto anyway = static_cast<double>(tree_.pmfByIntensity(0, leaf));
  if (!voxel.reached) return static_cast<float>(anyway);
  const auto after =
      std::upper_bound(voxel.clusters.begin(), voxel.clusters.end(), leaf,
                       [](uint32_t node, const Cluster& c) { return node < c.node; });
  const Cluster& c = *std::prev(after);
  const auto within = static_cast<double>(tree_.pmfByIntensity(c.node, leaf));
  return static_cast<float>(kDefensiveShare * anyway +
                            (1 - kDefensiveShare) * static_cast<double>(c.pmf) * within);
}

std::optional<SampledLight> SpatialLightDistribution::sample(const LightSampleContext& ctx,
                                                             float u) const {
  if (!(ctx.reflects || ctx.transmits) || (tree_.empty() && infinite_.empty())) return std::nullopt;
  const Voxel& voxel = voxelAt(ctx.p);
  double variate = refineVariate(u, ctx.p);
  if (chooseFirst(voxel.infiniteShare, 1 - voxel.infiniteShare, variate)) {
    auto drawn = infinite_.sample(everywhere(), variate);
    if (drawn) drawn->pmf = pmf(ctx, drawn->light);
    return drawn;
  }
  uint32_t node = 0;
  if (voxel.reached && !chooseFirst(kDefensiveShare, 1 - kDefensiveShare, variate)) {
    for (const Cluster& c : voxel.clusters) {
      if (!(c.pmf > 0)) continue;
      node = c.node;
      if (variate < static_cast<double>(c.pmf)) {
        variate /= static_cast<double>(c.pmf);
        break;
      }
      variate -= static_cast<double>(c.pmf);
    }
  }
  variate = std::min(variate, static_cast<double>(kOneMinusEpsilon));
  const LightId light = tree_.sampleByIntensity(node, variate).light;
  return SampledLight{light, pmf(ctx, light)};
}

float SpatialLightDistribution::pmf(const LightSampleContext& ctx, LightId light) const {
  if (!(ctx.reflects || ctx.transmits)) return 0;
  const uint32_t leaf = tree_.leafOf(light);
  const bool infinite = leaf == LightBVHAccel::kNoLeaf;
  if (infinite && !infinite_.contains(light)) return 0;
  const Voxel& voxel = voxelAt(ctx.p);
  if (infinite) return infinite_.pmf(everywhere(), light) * static_cast<float>(voxel.infiniteShare);
  return clusterPmf(voxel, leaf) * static_cast<float>(1 - voxel.infiniteShare);
}

std::unique_ptr<LightDistribution> create(const SpatialParameters& p,
                                          const LightDistributionContext& context) {
  return std::make_unique<SpatialLightDistribution>(p, context);
}

}  // namespace

LightDistributionRegistry::Entry spatialLightDistributionPlugin() {
  return makePlugin("spatial", "Lights by what they contribute to a voxel around the point.",
                    create);
}

}  // namespace lampyris
