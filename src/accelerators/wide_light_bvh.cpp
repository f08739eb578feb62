// SPDX-License-Identifier: Apache-2.0
#include "accelerators/wide_light_bvh.h"

#include <algorithm>

#include "accelerators/wide_light_bvh_builder.h"
#include "accelerators/wide_light_bvh_importance.h"
#include "accelerators/wide_light_bvh_way.h"
#include "core/prefetch.h"

namespace lampyris {
namespace {

constexpr size_t kWidth = WideLightBVHNode::kWidth;

/// Takes one of the children with a probability in proportion to its weight; not all are 0. Leaves
/// a fresh variate in `u`.
size_t choose(const ChildWeights& weights, double& u) {
  const double at = u * weights.total();
  size_t chosen = 0;
  for (const double sum : weights.upTo) chosen += static_cast<size_t>(sum <= at);
  if (chosen == kWidth) {  // by rounding only
    while (!(weights.of[--chosen] > 0)) continue;
  }
  const auto weight = static_cast<double>(weights.of[chosen]);
  u = std::clamp((at - (weights.upTo[chosen] - weight)) / weight, 0., 1 - DBL_EPSILON / 2);
  return chosen;
}

}  // namespace

WideLightBVH::WideLightBVH(const LightBVHAccel& tree) {
  slotOf_.assign(tree.idCount(), kNone);
  WideLightBVHBuilder(tree, *this).build();
  stats_.lights = lights_.size();
  stats_.nodes = nodes_.size();
  stats_.bytes = nodes_.size() * (sizeof(WideLightBVHNode) + sizeof(uint32_t)) +
                 lights_.size() * sizeof(LightId) + intensitiesBefore_.size() * sizeof(uint16_t) +
                 slotOf_.size() * sizeof(uint32_t);
}

void WideLightBVH::prefetchBelow(const WideLightBVHNode& node) const {
  constexpr size_t kCacheLine = 64;
  if (node.leaves) prefetchLine(&lights_[node.firstLight]);
  const char* const children = reinterpret_cast<const char*>(nodes_.data() + node.firstChild);
  const size_t bytes = static_cast<size_t>(std::popcount(node.inner)) * sizeof(WideLightBVHNode);
  for (size_t i = 0; i < bytes; i += kCacheLine) prefetchLine(children + i);
}

const WideLightBVHNode* WideLightBVH::alikeCluster(const WideLightBVHNode& node,
                                                   const ChildWeights& weights, size_t lane) const {
  if (!(weights.alike[lane] > 0) || node.isLeaf(lane)) return nullptr;
  const WideLightBVHNode& child = nodes_[node.child(lane)];
  return child.clusterLights > 0 ? &child : nullptr;
}

WideLightBVH::Descent WideLightBVH::endAt(const WideLightBVHNode& cluster, double u,
                                          double count) const {
  // Where it is if all are as strong: not far from where it is.
  const uint32_t first = cluster.firstLight, last = first + cluster.clusterLights - 1;
  const uint32_t place = std::min(first + static_cast<uint32_t>(u * cluster.clusterLights), last);
  prefetchLine(&lights_[place]);
  if (!cluster.even) {
    prefetchLine(&intensitiesBefore_[place]);
    prefetchLine(&intensitiesBefore_[first]);
    prefetchLine(&intensitiesBefore_[last + 1]);
  }
  return {&cluster, place, u, count};
}

SampledLight WideLightBVH::resolve(const Descent& end) const {
  uint32_t place = end.place;
  if (!end.cluster) return {lights_[place], static_cast<float>(end.count)};
  const WideLightBVHNode& cluster = *end.cluster;
  if (!cluster.even) {
    const uint32_t last = cluster.firstLight + cluster.clusterLights - 1;
    const Units units = unitsOf(cluster.firstLight, cluster.clusterLights);
    const auto at = units.begin + static_cast<uint32_t>(end.u * (units.end - units.begin));
    while (intensitiesBefore_[place] > at) --place;
    while (place < last && intensitiesBefore_[place + 1] <= at) ++place;
  }
  return {lights_[place], static_cast<float>(end.count * shareOfIntensity(cluster, place))};
}

double WideLightBVH::shareOfIntensity(const WideLightBVHNode& cluster, uint32_t place) const {
  if (cluster.even) return 1. / cluster.clusterLights;
  const Units all = unitsOf(cluster.firstLight, cluster.clusterLights), own = unitsOf(place, 1);
  return static_cast<double>(own.end - own.begin) / (all.end - all.begin);
}

WideLightBVH::Units WideLightBVH::unitsOf(uint32_t firstLight, uint32_t count) const {
  // Behind the last one of all there is a 0, as for the first one of any.
  const uint32_t next = intensitiesBefore_[firstLight + count];
  return {intensitiesBefore_[firstLight], next > 0 ? next : kWhole};
}

std::optional<SampledLight> WideLightBVH::sample(const LightReceiver& at, double u) const {
  if (nodes_.empty() || !at.receives()) return std::nullopt;
  std::optional<SampledLight> drawn;
  if (const auto end = descend(0, at, u, 1)) drawn = resolve(*end);
  return drawn;
}

std::optional<WideLightBVH::Descent> WideLightBVH::descend(uint32_t number, const LightReceiver& at,
                                                           double u, double count) const {
  while (true) {
    const WideLightBVHNode& node = nodes_[number];
    prefetchBelow(node);
    const ChildWeights weights = importances(node, at);
    if (!(weights.total() > 0)) return std::nullopt;
    const size_t lane = choose(weights, u);
    count *= static_cast<double>(weights.of[lane]) / weights.total();
    if (node.isLeaf(lane)) return Descent{nullptr, node.light(lane), u, count};
    if (const WideLightBVHNode* const cluster = alikeCluster(node, weights, lane))
      return endAt(*cluster, u, count);
    number = node.child(lane);
  }
}

float WideLightBVH::pmf(const LightReceiver& at, LightId light) const {
  const Way way(*this, light);
  if (way.empty() || !at.receives()) return 0;
  double pmf = 1;
  way.follow(*this, [&](const WideLightBVHNode& node, size_t lane) {
    const ChildWeights weights = importances(node, at);
    const auto weight = static_cast<double>(weights.of[lane]);
    pmf *= weight > 0 ? weight / weights.total() : 0;
    if (!(pmf > 0)) return false;
    const WideLightBVHNode* const cluster = alikeCluster(node, weights, lane);
    if (cluster) pmf *= shareOfIntensity(*cluster, way.place(*this));
    return !cluster;
  });
  return static_cast<float>(pmf);
}

float WideLightBVH::rootImportance(const LightReceiver& at) const {
  if (nodes_.empty() || !at.receives()) return 0;
  const ChildWeights weights = importances(nodes_[0], at);
  const double unit = static_cast<double>(nodes_[0].invExtent) * static_cast<double>(strongest_);
  const double irradiance = weights.total() * unit * static_cast<double>(nodes_[0].invExtent) /
                            static_cast<double>(weights.unit2);
  return static_cast<float>(std::min(irradiance, static_cast<double>(FLT_MAX)));
}

}  // namespace lampyris
