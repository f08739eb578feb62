// SPDX-License-Identifier: Apache-2.0
/// Importance of a node of the light BVH for a point: an estimate, and but for constant factors an
/// upper bound, of the irradiance by its lights.
///
/// Ma 2018, eq. 3.8 and 3.10, after Conty and Kulla 2018: intensity × cos θ' × cos θ'i / d², with
/// θ' = max(0, θ − θo − θb), 0 where θ' > θe, θ'i = max(0, θi − θb), and θb the angle that the
/// bounding sphere of the node's box subtends. Deviations: d² is at least the squared radius of
/// that sphere (no unit of length comes in); where only one side of the surface counts, nodes
/// behind it weigh nothing; small floors keep rounding from losing light.
#pragma once

#include <cfloat>

#include "accelerators/light_bvh_node.h"
#include "base/light_distribution.h"

namespace lampyris {

/// What of a shading point matters to a node.
class LightReceiver {
 public:
  explicit LightReceiver(const LightSampleContext& ctx) : p_(ctx.p), ns_(ctx.ns) {
    if (!ctx.reflects && !ctx.transmits) return;
    if (ctx.reflects && ctx.transmits) {
      sides_ = ctx.bsdf ? Sides::Both : Sides::Free;
      return;
    }
    const float facing = dot(ctx.n, ctx.wo);
    sides_ = facing == 0 ? Sides::Both : Sides::One;
    side_ = (facing > 0) == ctx.reflects ? ctx.n : -ctx.n;
    ns_ = faceForward(ctx.ns, side_);
  }
  /// Any point within `radius` of `center`, without a surface.
  LightReceiver(const Vec3& center, float radius)
      : p_(center), radius_(radius), sides_(Sides::Free) {}

  /// False if no light can contribute.
  bool receives() const { return sides_ != Sides::None; }
  /// ≥ 0, finite; > 0 if any light of the node contributes.
  double importance(const LinearLightBVHNode& node) const;
  /// The normal of the side that counts, for lights without a position; both sides if bothSides().
  const Vec3& side() const { return sides_ == Sides::One ? side_ : ns_; }
  const Vec3& shadingNormal() const { return ns_; }
  bool bothSides() const { return sides_ != Sides::One; }
  /// False in a volume: light counts alike from everywhere.
  bool hasSurface() const { return sides_ != Sides::Free; }

 private:
  enum class Sides : uint8_t { None, One, Both, Free };
  /// Least factor of either cosine.
  static constexpr float kFloor = 1e-3f;
  /// cos of max(0, θ − θb), by one square root for both sines.
  static float relax(float cosine, float sine2, float cosB, float sine2B) {
    return cosine >= cosB ? 1.f : cosine * cosB + std::sqrt(sine2 * sine2B);
  }
  float receiverFactor(const Vec3& d, float invLength, float cosB, float sine2B) const;

  Vec3 p_;
  Vec3 side_{0}, ns_{0, 0, 1};
  float radius_ = 0;
  Sides sides_ = Sides::None;
};

/// The cosine at the receiver. The BSDF tests sides by the geometric normal but weighs by
/// |cos| of the shading normal; where the two disagree about the node, so does this.
inline float LightReceiver::receiverFactor(const Vec3& d, float invLength, float cosB,
                                           float sine2B) const {
  if (sides_ == Sides::Free) return 1;
  float cosine = dot(ns_, d) * invLength;
  if (sides_ == Sides::Both || (cosine < 0 && dot(side_, d) >= 0)) cosine = std::abs(cosine);
  return std::max(relax(cosine, std::max(0.f, 1 - cosine * cosine), cosB, sine2B), kFloor);
}

inline double LightReceiver::importance(const LinearLightBVHNode& node) const {
  const Vec3 d = node.center() - p_, half = node.halfExtent();
  if (sides_ == Sides::One) {
    // The box's corner furthest in front; some ulps for the rounding of the terms.
    const Vec3 n = glm::abs(side_);
    if (dot(side_, d) + dot(n, half) < -1e-6f * dot(n, glm::abs(d))) return 0;
  }
  const float d2 = dot(d, d);
  float r2 = dot(half, half) * 1.00001f;  // so that rounding makes no angle θb too small
  if (radius_ > 0) r2 = sqr(std::sqrt(r2) + radius_);
  if (!(d2 > std::max(r2, FLT_MIN))) {
    if (d2 == 0 && r2 == 0) return 0;  // a point light sends nothing to where it is
    // Inside of the sphere nothing is known of directions.
    return static_cast<double>(node.intensity()) / static_cast<double>(std::max(r2, FLT_MIN));
  }

  const float invLength = 1 / std::sqrt(d2);
  const float invSquared = invLength * invLength;
  const float sine2B = std::min(r2 * invSquared, 1.f), cosB = std::sqrt(1 - sine2B);
  float factor = receiverFactor(d, invLength, cosB, sine2B);
  if (!node.allNormals()) {
    const Vec3 axis = node.axis();
    const float scale = invLength / length(axis);
    // The sine from the cross product: 1 − cos² has no digits for small angles.
    float cosine = -dot(axis, d) * scale;
    float sine = length(cross(axis, d)) * scale;
    if (node.twoSided()) cosine = std::abs(cosine);
    const float h = node.halfSineO();
    const float cosO = 1 - 2 * h * h, sinO = 2 * h * std::sqrt(1 - h * h);
    const float cosE = node.cosThetaE();
    if (cosine < cosO) {  // θ > θo
      const float cosX = cosine * cosO + sine * sinO;
      sine = sine * cosO - cosine * sinO;
      const float cosPrime = relax(cosX, sine * sine, cosB, sine2B);
      if (cosPrime < cosE - 1e-5f) return 0;
      // Wide emission is no cosine any more: what its edge sends is anyone's guess.
      factor *= std::max(cosPrime, cosE < 0 ? 0.1f : kFloor);
    }
  }
  return static_cast<double>(node.intensity()) * static_cast<double>(factor) *
         static_cast<double>(invSquared);
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
  __builtin_prefetch(&nodes[l.light()]);
  __builtin_prefetch(&nodes[r.light()]);
  return {at.importance(l), at.importance(r)};
}

}  // namespace lampyris
