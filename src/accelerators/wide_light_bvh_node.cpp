// SPDX-License-Identifier: Apache-2.0
#include "accelerators/wide_light_bvh_node.h"

#include <algorithm>

#include "core/bounds.h"

namespace lampyris {
namespace {

constexpr float kCenterMax = 65535, kByteMax = 255, kAxisMax = 127;
/// Weaker lights count as this strong beside the strongest one: still a normal float, and a
/// probability that no image can tell from the right one.
constexpr float kWeakest = 0x1p-100f;
/// Added to θo: what a cosine in floats can't resolve near 1.
constexpr double kConeError = 1e-3;
/// In 1/127: keeps a right angle one, which the binary node stores a little too wide. Less than the
/// tolerance with which cos θe is compared.
constexpr float kRightAngle = 8e-3f;

Bounds3 boxOf(const LinearLightBVHNode& n) {
  Bounds3 box(n.center() - n.halfExtent());
  box.extend(n.center() + n.halfExtent());
  return box;
}

/// The upper half of a float, rounded to nearest.
uint16_t packNearest(float v) {
  return static_cast<uint16_t>((std::bit_cast<uint32_t>(v) + 0x8000) >> 16);
}

}  // namespace

float WideLightBVHNode::encode(std::span<const LinearLightBVHNode* const> children,
                               float leastExtent) {
  Bounds3 box;
  float strongest = 0;
  for (const LinearLightBVHNode* c : children) {
    box.extend(boxOf(*c));
    strongest = std::max(strongest, c->intensity());
  }
  origin = box.min;
  const Vec3 edge = box.extent();
  // One scale for all axes keeps angles. A little more, so that rounding never exceeds the range.
  float extent = std::max(std::max({edge.x, edge.y, edge.z}) * 1.00001f, leastExtent);
  if (!std::isfinite(extent)) extent = std::numeric_limits<float>::max();
  invExtent = 1 / extent;
  for (size_t i = 0; i < children.size(); ++i) {
    const LinearLightBVHNode& c = *children[i];
    const auto bit = static_cast<uint8_t>(1u << i);
    (c.isLeaf() ? leaves : inner) |= bit;
    intensity[i] = packNearest(std::max(c.intensity() / strongest, kWeakest));
    encodeBox(i, c);
    encodeCone(i, c);
    if (!c.allNormals()) allNormals ^= bit;
    if (c.twoSided()) twoSided |= bit;
  }
  return strongest;
}

void WideLightBVHNode::encodeBox(size_t lane, const LinearLightBVHNode& child) {
  const Vec3 halfExtent = child.halfExtent();
  const auto scale = static_cast<double>(invExtent);
  for (size_t a = 0; a < 3; ++a) {
    const int axisIndex = static_cast<int>(a);
    const double exact =
        (static_cast<double>(child.center()[axisIndex]) - static_cast<double>(origin[axisIndex])) *
        scale;
    const double rounded = std::clamp(std::round(exact * kCenterMax), 0., double{kCenterMax});
    center[a][lane] = static_cast<uint16_t>(rounded);
    const double reach =
        std::abs(rounded / kCenterMax - exact) + static_cast<double>(halfExtent[axisIndex]) * scale;
    // A rounding error that floats can't see is none: points stay points.
    const double code = reach < 1e-9 ? 0 : std::ceil(std::sqrt(2 * reach) * kByteMax);
    half[a][lane] = static_cast<uint8_t>(std::min(code, double{kByteMax}));
  }
}

void WideLightBVHNode::encodeCone(size_t lane, const LinearLightBVHNode& child) {
  cosineE[lane] = static_cast<uint8_t>(
      std::clamp(std::floor((child.cosThetaE() + 1) * kAxisMax + kRightAngle), 0.f, 2 * kAxisMax));
  halfSineO[lane] = static_cast<uint8_t>(kByteMax);
  if (child.allNormals()) return;
  const Vec3 exact = normalize(child.axis());
  Vec3 stored;
  for (size_t a = 0; a < 3; ++a) {
    const float v = std::round(exact[static_cast<int>(a)] * kAxisMax);
    axis[a][lane] = static_cast<int8_t>(v);
    stored[static_cast<int>(a)] = v;
  }
  const double turned = std::atan2(static_cast<double>(length(cross(exact, stored))),
                                   static_cast<double>(dot(exact, stored)));
  const double thetaO =
      2 * std::asin(std::min(1., static_cast<double>(child.halfSineO()))) + turned + kConeError;
  const double sine = thetaO >= 3.141592653589793 ? 1 : std::sin(0.5 * thetaO);
  halfSineO[lane] = static_cast<uint8_t>(std::min(std::ceil(sine * kByteMax), double{kByteMax}));
}

}  // namespace lampyris
