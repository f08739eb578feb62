// SPDX-License-Identifier: Apache-2.0
#include "accelerators/light_bvh.h"

#include <cfloat>

#include "accelerators/light_bvh_builder.h"
#include "core/error.h"
#include "core/hash.h"

namespace lampyris {
namespace {

ChildImportances byIntensity(const LinearLightBVHNode* nodes, uint32_t parent) {
  return {static_cast<double>(nodes[parent + 1].intensity()),
          static_cast<double>(nodes[nodes[parent].rightChild()].intensity())};
}

float toFloat(double v) { return static_cast<float>(std::min(v, static_cast<double>(FLT_MAX))); }

}  // namespace

double refineVariate(float u, const Vec3& p) {
  const auto bits = [](float v) { return static_cast<uint64_t>(std::bit_cast<uint32_t>(v)); };
  const uint64_t h = mixBits((bits(p.x) << 32 | bits(p.y)) ^ mixBits(bits(p.z) << 32 | bits(u)));
  return static_cast<double>(u) + static_cast<double>(h >> 24) * 0x1p-64;
}

bool chooseFirst(double first, double second, double& u) {
  const double at = u * (first + second);
  const bool takesFirst = second <= 0 || (first > 0 && at < first);
  u = takesFirst ? at / first : (at - first) / second;
  if (!(u >= 0)) u = 0;
  if (!(u < 1)) u = 1 - DBL_EPSILON / 2;
  return takesFirst;
}

LightBVHAccel::LightBVHAccel(std::span<const LightBVHInput> lights) {
  LightId largest = 0;
  for (const LightBVHInput& l : lights) largest = std::max(largest, l.id);
  if (lights.size() > LinearLightBVHNode::kMaxIndex / 2 || largest >= LinearLightBVHNode::kMaxIndex)
    throw SceneError("too many lights: the light tree takes at most 1,073,741,823");
  if (lights.empty()) return;
  leafOf_.assign(static_cast<size_t>(largest) + 1, kNoLeaf);
  stats_.depth = buildLightBVH(lights, nodes_, leafOf_);
  stats_.nodes = nodes_.size();
  stats_.lights = (nodes_.size() + 1) / 2;
  stats_.dropped = lights.size() - stats_.lights;
  stats_.bytes = nodes_.size() * sizeof(LinearLightBVHNode) + leafOf_.size() * sizeof(uint32_t);
}

std::optional<SampledLight> LightBVHAccel::sample(const LightReceiver& at, double u) const {
  if (nodes_.empty()) return std::nullopt;
  if (!at.receives() || !(at.importance(nodes_[0]) > 0)) return std::nullopt;
  const LinearLightBVHNode* nodes = nodes_.data();
  double pmf = 1;
  uint32_t i = 0;
  while (!nodes[i].isLeaf()) {
    const ChildImportances children = childImportances(nodes, i, at);
    if (!children.any()) return std::nullopt;
    const bool goLeft = chooseFirst(children.left, children.right, u);
    pmf *= children.probability(goLeft);
    i = goLeft ? i + 1 : nodes[i].rightChild();
  }
  return SampledLight{nodes[i].light(), static_cast<float>(pmf)};
}

float LightBVHAccel::pmf(const LightReceiver& at, LightId light) const {
  const uint32_t leaf = leafOf(light);
  if (leaf == kNoLeaf) return 0;
  if (!at.receives() || !(at.importance(nodes_[0]) > 0)) return 0;
  const LinearLightBVHNode* nodes = nodes_.data();
  double pmf = 1;
  // Nodes lie depth first, so their numbers lead the way down.
  for (uint32_t i = 0; i != leaf;) {
    const ChildImportances children = childImportances(nodes, i, at);
    if (!children.any()) return 0;
    const bool goLeft = leaf < nodes[i].rightChild();
    pmf *= children.probability(goLeft);
    if (!(pmf > 0)) return 0;
    i = goLeft ? i + 1 : nodes[i].rightChild();
  }
  return static_cast<float>(pmf);
}

float LightBVHAccel::rootImportance(const LightReceiver& at) const {
  return !nodes_.empty() && at.receives() ? toFloat(at.importance(nodes_[0])) : 0;
}

SampledLight LightBVHAccel::sampleByIntensity(uint32_t node, double u) const {
  double pmf = 1;
  uint32_t i = node;
  while (!nodes_[i].isLeaf()) {
    const ChildImportances children = byIntensity(nodes_.data(), i);
    const bool goLeft = chooseFirst(children.left, children.right, u);
    pmf *= children.probability(goLeft);
    i = goLeft ? i + 1 : nodes_[i].rightChild();
  }
  return {nodes_[i].light(), static_cast<float>(pmf)};
}

float LightBVHAccel::pmfByIntensity(uint32_t node, uint32_t leaf) const {
  double pmf = 1;
  for (uint32_t i = node; i != leaf;) {
    const bool goLeft = leaf < nodes_[i].rightChild();
    pmf *= byIntensity(nodes_.data(), i).probability(goLeft);
    i = goLeft ? i + 1 : nodes_[i].rightChild();
  }
  return static_cast<float>(pmf);
}

}  // namespace lampyris
