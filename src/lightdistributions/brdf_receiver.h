// SPDX-License-Identifier: Apache-2.0
/// Importances of the children of a node of the wide light BVH for a point with a given BSDF and
/// view direction: estimates of the radiance that their lights cause.
///
/// Liu, Xu and Yan 2019, "Adaptive BRDF-Oriented Multiple Importance Sampling of Many Lights",
/// eqs. 5 and 6: intensity × cos θ' / d² × the mean of BRDF × cosine over the node's bounding
/// sphere as seen from the point. Glossy lobes are pivot transformed distributions (brdf_pivot.h),
/// diffuse ones have their closed form, transmitted ones look to the other side.
///
/// Deviations: intensity and emission factor are those of the plain tree; a floor keeps every light
/// that may contribute, since lobes are fits. Cost: eight children at once, with two square roots
/// and two dozen operations a lobe more than their plain importances; arc functions where the
/// horizon cuts a child.
#pragma once

#include <array>

#include "accelerators/wide_light_bvh_importance.h"
#include "lightdistributions/brdf_pivot_lanes.h"

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

  /// Of a node's children; 0 where there is none.
  struct Weights {
    /// ≥ 0, finite; > 0 if any light of the child contributes. But for the factor `unit`.
    alignas(32) std::array<float, WideLightBVHNode::kWidth> importance;
    /// Of the glossy lobes over the child's bounding sphere; all if inside of it.
    alignas(32) std::array<float, WideLightBVHNode::kWidth> integral;
    uint8_t inside;  ///< as bits: the point lies within the sphere
    uint8_t flat;    ///< as bits: BRDF × cosine is about the same for all the child's lights
    double unit;     ///< factor of importances; itself but for the node's strongest intensity

    double total() const;
  };
  Weights weigh(const WideLightBVHNode& node) const;
  /// The same without the BSDF, for parts of a flat child; no integrals.
  Weights weighEmission(const WideLightBVHNode& node) const;

 private:
  void addShapes(const Bsdf& bsdf, const Vec3& wo);
  void addLobe(const LobeShape& shape, const Vec3& wo);
  Float8 meanOfCosines(const CapLanes& caps) const;

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
