// SPDX-License-Identifier: Apache-2.0
#include "accelerators/light_bvh_node.h"

#include <algorithm>

namespace lampyris {
namespace {

constexpr double kPiD = 3.14159265358979323846;
/// More than the rounding of the float axes can turn a cone.
constexpr double kAxisError = 4e-7;

double angle(const Vec3& a, const Vec3& b) {
  const glm::dvec3 x(a), y(b);
  return std::atan2(glm::length(glm::cross(x, y)), glm::dot(x, y));
}

/// Rounds a half extent up to the 16 bits that are kept.
uint16_t packUp(float v) {
  return static_cast<uint16_t>((std::bit_cast<uint32_t>(v) + 0xffff) >> 16);
}

/// sin(θ/2), in units of 1/max, rounded up.
uint32_t packHalfSine(double halfSine, uint32_t max) {
  const double scaled = std::ceil(halfSine * static_cast<double>(max) - 1e-9);
  return std::min(static_cast<uint32_t>(scaled), max);
}

/// The octahedral map, on a grid of max + 1 points a side.
uint32_t packAxis(const Vec3& a, uint32_t max) {
  const float sum = std::abs(a.x) + std::abs(a.y) + std::abs(a.z);
  float x = a.x / sum, y = a.y / sum;
  if (a.z < 0) {
    const float ox = x;
    x = std::copysign(1 - std::abs(y), ox);
    y = std::copysign(1 - std::abs(ox), y);
  }
  const auto quantise = [max](float v) {
    const float scaled = std::clamp(v * 0.5f + 0.5f, 0.f, 1.f) * static_cast<float>(max);
    return static_cast<uint32_t>(std::lround(scaled));
  };
  return quantise(x) << 10 | quantise(y);
}

}  // namespace

EmissionCone EmissionCone::of(const LightBounds& bounds) {
  EmissionCone c;
  c.axis = normalize(bounds.axis);
  c.thetaO =
      bounds.cosThetaO > -1 ? std::acos(std::min(static_cast<double>(bounds.cosThetaO), 1.)) : kPiD;
  c.cosThetaE = std::clamp(static_cast<double>(bounds.cosThetaE), -1., 1.);
  c.twoSided = bounds.twoSided;
  // Unknown is everything.
  if (c.axis == Vec3(0)) c.axis = {0, 0, 1}, c.thetaO = kPiD;
  if (!(c.cosThetaE >= -1)) c.cosThetaE = -1;
  return c;
}

bool EmissionCone::isFull() const {
  // What a node would round up to a full cone is one already.
  return thetaO >= (twoSided ? 0.5 * kPiD - 1e-6 : kPiD - 0.06);
}

double EmissionCone::peakFactor() const {
  if (isFull()) return 1;
  const float m = capMean(static_cast<float>(std::cos(thetaO)));
  return static_cast<double>(twoSided ? meanAbsCosine(1, m) : meanCosine(1, m));
}

double EmissionCone::meanFactor() const {
  if (isFull()) return 1;
  const double reach = thetaO + std::acos(cosThetaE);
  // Within a narrow cone the factor is hardly less than at the axis.
  const double ofOneSide =
      reach < 0.5 * kPiD ? std::max(peakFactor() * sqr(std::sin(reach)), 1e-6) : 1;
  return (twoSided ? 0.5 : 0.25) * ofOneSide;
}

EmissionCone merge(const EmissionCone& a, const EmissionCone& b) {
  EmissionCone out;
  out.twoSided = a.twoSided || b.twoSided;
  out.cosThetaE = std::min(a.cosThetaE, b.cosThetaE);
  out.thetaO = kPiD;
  if (a.isFull() || b.isFull()) return out;
  Vec3 other = b.axis;
  if (out.twoSided && dot(a.axis, other) < 0) other = -other;
  const double between = angle(a.axis, other);
  if (between + b.thetaO <= a.thetaO) {
    out.axis = a.axis, out.thetaO = a.thetaO;
    return out;
  }
  if (between + a.thetaO <= b.thetaO) {
    out.axis = other, out.thetaO = b.thetaO;
    return out;
  }
  const double half = 0.5 * (a.thetaO + between + b.thetaO);
  if (half >= kPiD) return out;
  // The axis on the great circle from a to b, at half − θo(a) from a.
  const double turn = half - a.thetaO;
  const glm::dvec3 from(a.axis);
  glm::dvec3 across = glm::dvec3(other) - glm::dot(from, glm::dvec3(other)) * from;
  const double sine = glm::length(across);
  if (sine > 1e-6) {
    across /= sine;
  } else {  // opposite axes: any great circle does
    const glm::dvec3 helper = std::abs(from.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
    across = glm::normalize(glm::cross(from, helper));
  }
  out.axis = Vec3(glm::normalize(std::cos(turn) * from + std::sin(turn) * across));
  out.thetaO = std::min(kPiD, kAxisError + std::max(angle(out.axis, a.axis) + a.thetaO,
                                                    angle(out.axis, other) + b.thetaO));
  return out;
}

LinearLightBVHNode::LinearLightBVHNode(const Bounds3& box, const EmissionCone& cone,
                                       float intensity, bool leaf, uint32_t index)
    : center_(box.centroid()),
      intensity_(intensity),
      index_(index | static_cast<uint32_t>(leaf) << 31) {
  for (int i = 0; i < 3; ++i)
    half_[static_cast<size_t>(i)] =
        packUp(std::max(0.f, std::max(box.max[i] - center_[i], center_[i] - box.min[i])));
  cone_ = packAxis(cone.axis, kAxisMax) << 12;
  double halfSine = 1;
  if (!cone.isFull()) {
    const double widened = cone.thetaO + angle(axis(), cone.axis) + kAxisError;
    halfSine = std::sin(0.5 * std::min(widened, kPiD));
  }
  cone_ |= packHalfSine(halfSine, kSineMax);
  const double halfSineE = std::sqrt(0.5 * (1 - cone.cosThetaE));
  emission_ = static_cast<uint16_t>(packHalfSine(halfSineE, kEmissionMax) << 1 |
                                    static_cast<uint32_t>(cone.twoSided));
}

}  // namespace lampyris
