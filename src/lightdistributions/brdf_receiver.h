// SPDX-License-Identifier: Apache-2.0
/// Importance of a node of the light BVH for a point with a given BSDF and view direction: an
/// estimate of the radiance that its lights cause.
///
/// Liu, Xu and Yan 2019, "Adaptive BRDF-Oriented Multiple Importance Sampling of Many Lights",
/// eqs. 5 and 6: intensity × cos θ' / d² × the mean of BRDF × cosine over the node's bounding
/// sphere as seen from the point. Glossy lobes are pivot transformed distributions (brdf_pivot.h),
/// diffuse ones have their closed form, transmitted ones look to the other side.
///
/// Deviations: intensity and emission factor are those of the plain tree; a floor keeps every light
/// that may contribute, since lobes are fits. Cost: one square root and a dozen products a lobe
/// more than the plain importance; arc functions where the horizon cuts a node.
#pragma once

#include <array>

#include "accelerators/light_bvh_importance.h"
#include "lightdistributions/brdf_pivot.h"

namespace lampyris {

class BrdfReceiver {
 public:
  explicit BrdfReceiver(const LightSampleContext& ctx);

  /// False where none need be made to know that isGlossy() is false.
  static bool isWorthwhile(const LightSampleContext& ctx) {
    return ctx.bsdf && !ctx.bsdf->isDiffuse();
  }
  /// False if no lobe is narrower than a cosine's: the plain tree does as well.
  bool isGlossy() const { return lobeCount_ > 0; }
  /// About what all lobes scatter of light from everywhere, and the glossy ones alone (luminance).
  float albedo() const { return albedo_; }
  float glossyAlbedo() const { return glossyAlbedo_; }

  struct Estimate {
    double importance = 0;  ///< ≥ 0, finite; > 0 if any light of the node contributes
    float integral = 0;     ///< of the glossy lobes over the node's sphere; all if inside of it
    bool inside = false;    ///< the point lies within the sphere
    bool flat = false;      ///< BRDF × cosine is about the same for all the node's lights
  };
  Estimate estimate(const LinearLightBVHNode& node) const;
  /// The same without the BSDF, for parts of a flat node: 0 where importance is, or > 0.
  double emission(const LinearLightBVHNode& node) const {
    const Vec3 d = node.center() - p_;
    return oneSided_ && isBehind(node, d) ? 0 : emission_.importance(node);
  }

 private:
  void addShapes(const Bsdf& bsdf, const Vec3& wo);
  void addLobe(const LobeShape& shape, const Vec3& wo);
  /// All of the node's box is; some ulps for the rounding of the terms.
  bool isBehind(const LinearLightBVHNode& node, const Vec3& d) const {
    const Vec3 n = glm::abs(side_);
    return dot(side_, d) + dot(n, node.halfExtent()) < -1e-6f * dot(n, glm::abs(d));
  }
  float meanOfCosines(const DirectionCap& cap) const;

  Vec3 p_;
  LightReceiver emission_;  ///< of any orientation: for what leaves the node alone
  Vec3 side_{0};            ///< geometric normal of the only side that counts
  bool oneSided_ = false;
  Vec3 up_{0, 0, 1};  ///< shading normal on wo's side
  float diffuseReflected_ = 0, diffuseTransmitted_ = 0;
  float albedo_ = 0, glossyAlbedo_ = 0;
  size_t lobeCount_ = 0;
  std::array<PivotLobe, Bsdf::kMaxLobes * Lobe::kMaxShapes> lobes_;
};

}  // namespace lampyris
