// SPDX-License-Identifier: Apache-2.0
/// Importance of a node of the light BVH for a point: an estimate of the irradiance by its lights.
///
/// Ma 2018, eq. 3.10, after Conty and Kulla 2018: intensity × emission factor × receiver factor /
/// d². Deviations: both factors and 1/d² are means over the node's lights as they may lie, not
/// bounds, which saturate for large nodes and so say nothing at the top of the tree; nodes that
/// emit away from the point, or behind the only side of the surface that counts, weigh nothing;
/// small floors keep rounding from losing light. The bounds are there for comparison. Derivation
/// and measurements: docs/light-bvh.md.
#pragma once

#include <cfloat>

#include "accelerators/light_bvh_node.h"
#include "base/light_distribution.h"
#include "core/prefetch.h"

namespace lampyris {

/// What the factors of an importance are.
enum class LightFactors : uint8_t {
  Mean,
  /// Bounds over the node, by cos of max(0, θ − θo − θb) and of max(0, θi − θb), with θb the angle
  /// that the bounding sphere subtends, and the distance of the centre, at least the radius.
  Bound,
  /// The same without a cosine at the receiver: Ma 2018, eq. 3.8.
  Thesis,
};

/// What of a shading point matters to a node.
class LightReceiver {
 public:
  explicit LightReceiver(const LightSampleContext& ctx, LightFactors factors = LightFactors::Mean)
      : p_(ctx.p), ns_(ctx.ns), factors_(factors) {
    if (!ctx.reflects && !ctx.transmits) return;
    if (ctx.reflects && ctx.transmits) {
      sides_ = ctx.bsdf ? Sides::Both : Sides::Free;
      return;
    }
    const float facing = dot(ctx.n, ctx.wo);
    sides_ = facing == 0 ? Sides::Both : Sides::One;
    side_ = (facing > 0) == ctx.reflects ? ctx.n : -ctx.n;
    ns_ = faceForward(ctx.ns, side_);
    if (ns_ == side_) return;
    const float tilt = length(cross(ns_, side_));
    if (tilt > kFloor) tilt_ = tilt;
  }
  /// Any point within `radius` of `center`, without a surface.
  LightReceiver(const Vec3& center, float radius)
      : p_(center), radius_(radius), sides_(Sides::Free) {}

  const Vec3& position() const { return p_; }
  /// False if no light can contribute.
  bool receives() const { return sides_ != Sides::None; }
  /// ≥ 0, finite; > 0 if any light of the node contributes.
  double importance(const LinearLightBVHNode& node) const;
  /// The normal of the side that counts, for lights without a position; both sides if bothSides().
  const Vec3& side() const { return sides_ == Sides::One ? side_ : ns_; }
  const Vec3& shadingNormal() const { return ns_; }
  /// The largest |cos| with the shading normal of a direction that the geometric normal has in
  /// front and the shading normal behind: the BSDF tests by the one and weighs by the other.
  float tilt() const { return tilt_; }
  bool bothSides() const { return sides_ != Sides::One; }
  /// False in a volume: light counts alike from everywhere.
  bool hasSurface() const { return sides_ != Sides::Free; }

  /// Least factor of either cosine.
  static constexpr float kFloor = 1e-3f;
  /// Least squared distance from a box, relative to its squared radius: measured,
  /// docs/light-bvh.md.
  static constexpr float kNearest2 = 1.f / 32;
  /// Least emission factor where θe is more than a right angle: wide emission is no cosine any
  /// more, and what its edge sends is anyone's guess.
  static constexpr float kWideEmissionFloor = 0.1f;

 private:
  enum class Sides : uint8_t { None, One, Both, Free };
  /// cos of max(0, θ − θb), by one square root for both sines.
  static float relax(float cosine, float sine2, float cosB, float sine2B) {
    return cosB <= 0 || cosine >= cosB ? 1.f : cosine * cosB + std::sqrt(sine2 * sine2B);
  }
  float emissionFactor(const LinearLightBVHNode& node, const Vec3& d, float invLength, float cosB,
                       float sine2B) const;
  static float meanSquaredDistance(const Vec3& d, const Vec3& half, float d2, float r2);
  float receiverFactor(const Vec3& d, float invLength, float cosB, float sine2B) const;

  Vec3 p_;
  Vec3 side_{0}, ns_{0, 0, 1};
  float radius_ = 0;
  float tilt_ = 0;  ///< sine between the normals, if one side counts and they differ
  LightFactors factors_ = LightFactors::Mean;
  Sides sides_ = Sides::None;
};

/// The cosine at the receiver. The BSDF tests sides by the geometric normal but weighs by
/// |cos| of the shading normal; where the latter is behind, |cos| is the sine between the two at
/// most.
inline float LightReceiver::receiverFactor(const Vec3& d, float invLength, float cosB,
                                           float sine2B) const {
  if (sides_ == Sides::Free) return 1;
  float cosine = std::clamp(dot(ns_, d) * invLength, -1.f, 1.f);
  if (sides_ == Sides::Both) cosine = std::abs(cosine);
  if (tilt_ > 0 && cosine < 0) cosine = std::min(-cosine, tilt_);
  if (factors_ == LightFactors::Thesis) return 1;
  if (factors_ == LightFactors::Bound)
    return std::max(kFloor, relax(cosine, std::max(0.f, 1 - cosine * cosine), cosB, sine2B));
  const float m = capMean(cosB);
  return std::max(kFloor, bothSides() ? meanAbsCosine(cosine, m) : meanCosine(cosine, m));
}

/// 0 where nothing is emitted towards the receiver.
inline float LightReceiver::emissionFactor(const LinearLightBVHNode& node, const Vec3& d,
                                           float invLength, float cosB, float sine2B) const {
  if (node.allNormals()) return 1;
  const Vec3 axis = node.axis();
  const float scale = invLength / length(axis);
  // The sine from the cross product: 1 − cos² has no digits for small angles.
  float cosine = -dot(axis, d) * scale;
  const float sine = length(cross(axis, d)) * scale;
  if (node.twoSided()) cosine = std::abs(cosine);
  const float h = node.halfSineO();
  const float cosO = 1 - 2 * h * h, sinO = 2 * h * std::sqrt(1 - h * h), cosE = node.cosThetaE();
  float bound = 1;
  if (cosine < cosO) {  // θ > θo
    bound = relax(cosine * cosO + sine * sinO, sqr(sine * cosO - cosine * sinO), cosB, sine2B);
    if (bound < cosE - 1e-5f) return 0;
  }
  if (factors_ == LightFactors::Mean) {
    const float m = capMean(cosO) * capMean(cosB);
    bound = node.twoSided() ? meanAbsCosine(cosine, m) : meanCosine(cosine, m);
  }
  return std::max(cosE < 0 ? kWideEmissionFloor : kFloor, bound);
}

/// What 1/d² is on average over lights spread over a box: 1 / (distance of the box × distance of
/// its far end). Exact but for a factor of π/2 for strips, where 1/d² of the centre falls short by
/// length over distance, and too much, but bounded, for the inside of boxes.
inline float LightReceiver::meanSquaredDistance(const Vec3& d, const Vec3& half, float d2,
                                                float r2) {
  const Vec3 toBox = glm::max(absComponents(d) - half, Vec3(0));
  const float least = std::max(r2 * kNearest2, FLT_MIN);
  // The root of the factors, since their product may leave the range of floats.
  return std::sqrt(std::max(least, dot(toBox, toBox))) * std::sqrt(std::max(least, d2 + r2));
}

inline double LightReceiver::importance(const LinearLightBVHNode& node) const {
  const Vec3 d = node.center() - p_, half = node.halfExtent();
  if (sides_ == Sides::One) {
    // The box's corner furthest in front; some ulps for the rounding of the terms.
    const Vec3 n = absComponents(side_);
    if (dot(side_, d) + dot(n, half) < -1e-6f * dot(n, absComponents(d))) return 0;
  }
  const float d2 = dot(d, d);
  float r2 = dot(half, half) * 1.00001f;  // so that rounding makes no angle θb too small
  if (radius_ > 0) r2 = sqr(std::sqrt(r2) + radius_);
  if (d2 == 0 && r2 == 0) return 0;  // a point light sends nothing to where it is
  const float apart2 = std::max({FLT_MIN, r2, d2});
  const float over =
      factors_ == LightFactors::Mean ? meanSquaredDistance(d, half + radius_, d2, r2) : apart2;
  const float invLength = 1 / std::sqrt(apart2);
  const float sine2B = std::min(r2 * invLength * invLength, 1.f);
  // Within the sphere lights may lie in any direction.
  const float cosB = d2 > r2 ? std::sqrt(1 - sine2B) : 0;
  const float factor =
      receiverFactor(d, invLength, cosB, sine2B) * emissionFactor(node, d, invLength, cosB, sine2B);
  return static_cast<double>(node.intensity()) * static_cast<double>(factor) /
         static_cast<double>(over);
}

/// Importances of the two children of an inner node; both 0 if neither can contribute.
struct ChildImportances {
  double left, right;

  bool any() const { return left + right > 0; }
  double probability(bool ofLeft) const { return (ofLeft ? left : right) / (left + right); }
};
/// The one place that says them: sampling and pmf must agree to the last bit.
inline ChildImportances childImportances(const LinearLightBVHNode* nodes, uint32_t parent,
                                         const LightReceiver& at) {
  const LinearLightBVHNode& l = nodes[parent + 1];
  const LinearLightBVHNode& r = nodes[nodes[parent].rightChild()];
  // The next level's nodes, whichever child it will be: their latency is most of a descent's time.
  prefetchLine(&nodes[l.light()]);
  prefetchLine(&nodes[r.light()]);
  return {at.importance(l), at.importance(r)};
}

}  // namespace lampyris
