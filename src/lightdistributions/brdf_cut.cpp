// SPDX-License-Identifier: Apache-2.0
#include "lightdistributions/brdf_cut.h"

#include <numeric>
#include <span>

#include "accelerators/wide_light_bvh_way.h"

namespace lampyris {

namespace {

/// Takes one of several with a probability in proportion to its weight; not all are 0, `total` is
/// their sum. Leaves a fresh variate in `u`.
template <class Weights>
size_t choose(const Weights& weights, double total, double& u) {
  double left = u * total;
  size_t chosen = 0;
  double weight = 1;
  for (size_t i = 0; i < weights.size(); ++i) {
    const auto w = static_cast<double>(weights[i]);
    if (!(w > 0)) continue;
    chosen = i, weight = w;
    if (left < w) break;
    left -= w;
  }
  // Rounding may leave more than the last one has.
  u = std::clamp(left / weight, 0., 1 - DBL_EPSILON);
  return chosen;
}

/// Of the children of a node below the cut; `flat`: of a cluster where the BSDF says nothing.
BrdfReceiver::Weights weightsBelow(const WideLightBVHNode& node, const BrdfReceiver& at,
                                   bool flat) {
  return flat ? at.weighEmission(node) : at.weigh(node);
}

float intensityOf(const WideLightBVHNode& node, size_t lane) {
  return std::bit_cast<float>(static_cast<uint32_t>(node.intensity[lane]) << 16);
}
/// Intensities are relative to a node's strongest child; they add up to that of the node.
double sumOfIntensities(const WideLightBVHNode& node) {
  float sum = 0;
  for (size_t i = 0; i < WideLightBVHNode::kWidth; ++i) sum += intensityOf(node, i);
  return static_cast<double>(sum);
}

}  // namespace

BrdfCut::BrdfCut(const WideLightBVH& tree, const BrdfReceiver& at, float threshold) : tree_(tree) {
  if (tree.empty()) return;
  look(0, static_cast<double>(tree.strongest()), at, threshold);
  const auto byIntegral = [](const Wide& a, const Wide& b) { return a.integral < b.integral; };
  while (wideCount_ > 0) {
    Wide& next = *std::max_element(wide_.begin(), wide_.begin() + wideCount_, byIntegral);
    if (partCount_ == kMostNodes) {
      largest_ = std::max(largest_, next.integral);
      break;
    }
    const Wide chosen = next;
    next = wide_[--wideCount_];
    split(chosen, at, threshold);
  }
  for (size_t i = 0; i < partCount_; ++i) {
    totals_[i] = std::accumulate(parts_[i].weight.begin(), parts_[i].weight.end(), 0.);
    total_ += totals_[i];
  }
}

void BrdfCut::look(uint32_t number, double strongest, const BrdfReceiver& at, float threshold) {
  const WideLightBVHNode& node = tree_.nodes()[number];
  const BrdfReceiver::Weights weights = at.weigh(node);
  const double unit = weights.unit * strongest;
  Part& part = parts_[partCount_];
  part.node = number;
  part.flat = weights.flat;
  part.strongest = strongest;
  part.part.fill(kWhole);
  for (size_t i = 0; i < kWidth; ++i) {
    part.weight[i] = static_cast<double>(weights.importance[i]) * unit;
    if (!(part.weight[i] > 0)) continue;
    ++size_;
    const float integral = weights.integral[i];
    if (!node.isLeaf(i) && ((weights.inside >> i & 1) || integral > threshold))
      wide_[wideCount_++] = {integral, static_cast<uint8_t>(partCount_), static_cast<uint8_t>(i)};
    else
      largest_ = std::max(largest_, integral);
  }
  ++partCount_;
}

void BrdfCut::split(const Wide& which, const BrdfReceiver& at, float threshold) {
  Part& part = parts_[which.part];
  const WideLightBVHNode& node = tree_.nodes()[part.node];
  const uint32_t child = node.child(which.lane);
  part.weight[which.lane] = 0;
  part.part[which.lane] = static_cast<uint8_t>(partCount_);
  --size_;
  const double own = part.strongest * static_cast<double>(intensityOf(node, which.lane));
  look(child, own / sumOfIntensities(tree_.nodes()[child]), at, threshold);
}

float BrdfCut::shareOfSingleLights() const {
  if (!(total_ > 0)) return 0;
  double single = 0;
  for (size_t i = 0; i < partCount_; ++i)
    for (size_t lane = 0; lane < kWidth; ++lane)
      if (tree_.nodes()[parts_[i].node].isLeaf(lane)) single += parts_[i].weight[lane];
  return static_cast<float>(single / total_);
}

std::optional<SampledLight> BrdfCut::sample(const BrdfReceiver& at, double u) const {
  if (!(total_ > 0)) return std::nullopt;
  const size_t chosen = choose(std::span(totals_.data(), partCount_), total_, u);
  const Part& part = parts_[chosen];
  size_t lane = choose(part.weight, totals_[chosen], u);
  double pmf = part.weight[lane] / total_;
  bool flat = part.flat >> lane & 1;
  const WideLightBVHNode* node = &tree_.nodes()[part.node];
  while (!node->isLeaf(lane)) {
    node = &tree_.nodes()[node->child(lane)];
    const BrdfReceiver::Weights weights = weightsBelow(*node, at, flat);
    const double total = weights.total();
    if (!(total > 0)) return std::nullopt;
    lane = choose(weights.importance, total, u);
    pmf *= static_cast<double>(weights.importance[lane]) / total;
    flat = flat || (weights.flat >> lane & 1);
  }
  return SampledLight{tree_.lightAt(*node, lane), static_cast<float>(pmf)};
}

float BrdfCut::pmf(const BrdfReceiver& at, LightId light) const {
  const WideLightBVH::Way way(tree_, light);
  if (way.empty() || !(total_ > 0)) return 0;
  const Part* part = parts_.data();
  double pmf = 0;
  bool flat = false;
  way.follow(tree_, [&](const WideLightBVHNode& node, size_t lane) {
    if (part) {
      flat = part->flat >> lane & 1;
      pmf = part->weight[lane] / total_;
      const uint8_t next = part->part[lane];
      part = next == kWhole ? nullptr : &parts_[next];
      return part || pmf > 0;
    }
    const BrdfReceiver::Weights weights = weightsBelow(node, at, flat);
    const auto weight = static_cast<double>(weights.importance[lane]);
    pmf *= weight > 0 ? weight / weights.total() : 0;
    flat = flat || (weights.flat >> lane & 1);
    return pmf > 0;
  });
  return static_cast<float>(pmf);
}

}  // namespace lampyris
