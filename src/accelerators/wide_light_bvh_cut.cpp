// SPDX-License-Identifier: Apache-2.0
// Splitting of the wide light BVH, see wide_light_bvh.h.
//
// A subtree gets a budget: how many lights it may give. With a budget of one it gives one light, by
// descent. A larger budget b is shared out among the children: one whose share b·w/Σw is at least 1
// gets the whole part of it (or 1 if it is not to be split any further), the others form as many
// groups as there is budget left, side by side in space and alike in weight; a group gives one
// light in all. So no light's chance is ever nought, the budget is never exceeded, and a strong
// child is no longer left to chance.
#include <algorithm>
#include <bit>
#include <cmath>

#include "accelerators/wide_light_bvh.h"
#include "accelerators/wide_light_bvh_importance.h"
#include "accelerators/wide_light_bvh_way.h"
#include "core/prefetch.h"

namespace lampyris {
namespace {

constexpr size_t kWidth = WideLightBVHNode::kWidth;

/// How a node's budget goes to its children.
struct Shares {
  std::array<uint8_t, kWidth> group;    ///< of each child; children of weight 0: any
  std::array<uint32_t, kWidth> budget;  ///< of each group
  std::array<double, kWidth> weight{};  ///< of each group
  size_t groups = 0;

  Shares(const ChildWeights& weights, uint32_t total, uint8_t splittable);
};

/// The children that are worth a light but can't give more than one: what their shares are beyond
/// that goes to the others.
struct Singles {
  unsigned set = 0;
  double scale;  ///< the share of every other child is this times its weight

  Singles(const ChildWeights& weights, uint32_t total, uint8_t splittable) {
    double budget = total, weight = weights.total();
    // Every one that is found raises the others' shares.
    for (bool more = true; more;) {
      more = false;
      for (size_t i = 0; i < kWidth; ++i) {
        const auto w = static_cast<double>(weights.of[i]);
        if ((set | splittable) >> i & 1 || !(w > 0) || w * budget < weight) continue;
        set |= 1u << i;
        budget -= 1, weight -= w;
        more = true;
      }
    }
    scale = weight > 0 ? budget / weight : 0;
  }
};

Shares::Shares(const ChildWeights& weights, uint32_t total, uint8_t splittable) {
  const Singles singles(weights, total, splittable);
  uint32_t left = total;
  double restWeight = 0;
  uint32_t rest = 0;
  unsigned strong = 0;
  for (size_t i = 0; i < kWidth; ++i) {
    const auto w = static_cast<double>(weights.of[i]);
    const double share = singles.set >> i & 1 ? 1 : w * singles.scale;
    if (!(share >= 1) || left == 0) {
      restWeight += w;
      rest += w > 0;
      continue;
    }
    strong |= 1u << i;
    group[i] = static_cast<uint8_t>(groups);
    weight[groups] = w;
    const uint32_t own = splittable >> i & 1 ? static_cast<uint32_t>(share) : 1;
    budget[groups] = std::min(own, left);
    left -= budget[groups++];
  }
  if (rest == 0) return;
  // The whole parts leave at least 1 for the rest, but for rounding: then the last strong child
  // gives up one.
  if (left == 0) {
    left = 1;
    if (budget[groups - 1] > 1) {
      --budget[groups - 1];
    } else {
      const auto demoted = static_cast<size_t>(std::bit_width(strong) - 1);
      strong ^= 1u << demoted;
      restWeight += static_cast<double>(weights.of[demoted]);
      ++rest, --groups;
    }
  }
  const uint32_t restGroups = std::min(left, rest);
  double before = 0;
  int last = -1;
  for (size_t i = 0; i < kWidth; ++i) {
    const auto w = static_cast<double>(weights.of[i]);
    if (!(w > 0) || (strong >> i & 1)) continue;
    const double place = (before + 0.5 * w) / restWeight * restGroups;
    // Rounding may put a weight of nearly nothing behind the last place.
    const int nth = std::min(static_cast<int>(place), static_cast<int>(restGroups) - 1);
    const int mine = rest <= restGroups ? last + 1 : std::max(last, nth);
    if (mine != last) budget[groups] = 1, weight[groups++] = 0;
    last = mine;
    group[i] = static_cast<uint8_t>(groups - 1);
    weight[groups - 1] += w;
    before += w;
  }
}

/// Takes one child of a group, as choose() does of all.
size_t chooseIn(const Shares& shares, size_t group, const ChildWeights& weights, double& u) {
  double at = u * shares.weight[group];
  size_t chosen = kWidth;
  double weight = 1;
  for (size_t i = 0; i < kWidth; ++i) {
    const auto w = static_cast<double>(weights.of[i]);
    if (!(w > 0) || shares.group[i] != group) continue;
    chosen = i, weight = w;
    if (at < w) break;
    at -= w;
  }
  u = std::clamp(at / weight, 0., 1 - DBL_EPSILON / 2);
  return chosen;
}

}  // namespace

// With distances spread evenly over d − r … d + r, the square of CV is 4 r² / (3 (d² − r²)).
LightSplitting::LightSplitting(float threshold, uint32_t maxCut)
    : maxCut_(threshold < 1 ? std::max(maxCut, 1u) : 1) {
  const double cv = std::pow(std::max(1 - static_cast<double>(threshold), 1e-9), -4.) - 1;
  ratio_ = static_cast<float>(std::min(0.75 * cv * cv, 1e30));
}

LightSplitting LightSplitting::forPoint(float worth) const {
  LightSplitting s = *this;
  s.maxCut_ = std::max(1u, static_cast<uint32_t>(std::lround(worth * static_cast<float>(maxCut_))));
  return s;
}

class WideLightBVH::Cut {
 public:
  Cut(const WideLightBVH& tree, const LightReceiver& receiver, double first, float splitRatio,
      SampledLights& lights)
      : at(receiver), ratio(splitRatio), tree_(tree), out_(lights), first_(first) {}

  /// A variate for each cluster: a sequence of Weyl, stratified whatever their number.
  double next() {
    const double u = first_ + static_cast<double>(count_++) * 0.6180339887498949;
    return u - std::floor(u);
  }

  /// Its light comes into the cut a few descents later, when memory has it.
  void add(const std::optional<Descent>& end) {
    if (!end) return;
    if (ends_ - resolved_ == pending_.size()) resolveNext();
    pending_[ends_++ % pending_.size()] = *end;
  }
  void finish() {
    while (resolved_ < ends_) resolveNext();
  }

  const LightReceiver& at;
  const float ratio;

 private:
  void resolveNext() { out_.push_back(tree_.resolve(pending_[resolved_++ % pending_.size()])); }

  const WideLightBVH& tree_;
  SampledLights& out_;
  double first_;
  uint32_t count_ = 0;
  std::array<Descent, 4> pending_;
  uint32_t ends_ = 0, resolved_ = 0;
};

uint32_t WideLightBVH::rootBudget(const LightReceiver& at, const LightSplitting& splitting) const {
  const Vec3 d = center_ - at.position();
  const bool isNear = radius2_ >= splitting.ratio() * (dot(d, d) - radius2_);
  return isNear ? splitting.maxCut() : 1;
}

void WideLightBVH::sampleCut(const LightReceiver& at, double u, const LightSplitting& splitting,
                             SampledLights& out) const {
  if (nodes_.empty() || !at.receives()) return;
  if (splitting.takesAll(lights_.size())) {
    for (const LightId light : lights_) out.push_back({light, 1});
    return;
  }
  Cut cut(*this, at, u, splitting.ratio(), out);
  split(0, rootBudget(at, splitting), cut);
  cut.finish();
}

void WideLightBVH::split(uint32_t number, uint32_t budget, Cut& cut) const {
  if (budget <= 1) {
    cut.add(descend(number, cut.at, cut.next(), 1));
    return;
  }
  const WideLightBVHNode& node = nodes_[number];
  const ChildWeights weights = importances(node, cut.at);
  if (!(weights.total() > 0)) return;
  const Shares shares(weights, budget,
                      node.inner & nearChildren(node, cut.at.position(), cut.ratio));
  for (size_t g = 0; g < shares.groups; ++g) {
    double u = cut.next();
    const size_t lane = chooseIn(shares, g, weights, u);
    if (shares.budget[g] > 1) {
      split(node.child(lane), shares.budget[g], cut);
      continue;
    }
    const double count = static_cast<double>(weights.of[lane]) / shares.weight[g];
    if (node.isLeaf(lane)) {
      prefetchLine(&lights_[node.light(lane)]);
      cut.add(Descent{nullptr, node.light(lane), u, count});
    } else {
      cut.add(descend(node.child(lane), cut.at, u, count));
    }
  }
}

float WideLightBVH::expectedCount(const LightReceiver& at, LightId light,
                                  const LightSplitting& splitting) const {
  const Way way(*this, light);
  if (way.empty() || !at.receives()) return 0;
  if (splitting.takesAll(lights_.size())) return 1;
  uint32_t budget = rootBudget(at, splitting);
  double count = 1;
  way.follow(*this, [&](const WideLightBVHNode& node, size_t lane) {
    const ChildWeights weights = importances(node, at);
    const auto weight = static_cast<double>(weights.of[lane]);
    if (!(weight > 0)) {
      count = 0;
    } else if (budget <= 1) {
      count *= weight / weights.total();
      if (const WideLightBVHNode* const cluster = alikeCluster(node, weights, lane)) {
        count *= shareOfIntensity(*cluster, way.place(*this));
        return false;
      }
    } else {
      const Shares shares(weights, budget,
                          node.inner & nearChildren(node, at.position(), splitting.ratio()));
      const size_t group = shares.group[lane];
      count *= weight / shares.weight[group];
      budget = shares.budget[group];
    }
    return count > 0;
  });
  return static_cast<float>(count);
}

}  // namespace lampyris
