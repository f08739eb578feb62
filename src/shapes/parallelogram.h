// SPDX-License-Identifier: Apache-2.0
/// A parallelogram to draw points from: two triangles of a mesh as one light. A choice between them
/// would cost as much as the draw, and split the variates' stratification.
#pragma once

#include <array>
#include <memory>

#include "base/sampled_surface.h"

namespace lampyris {

/// Drawn from uniformly by solid angle where it is large against its distance, as two spherical
/// triangles that share a diagonal; else by area. See docs/shape-sampling.md.
class Parallelogram final : public SampledSurface {
 public:
  /// With corners in order around it; `normal` (unit) to its front. Null unless it is one up to
  /// rounding, and has an area whose inverse is finite.
  static std::unique_ptr<const Parallelogram> make(const std::array<Vec3, 4>& corners,
                                                   const Vec3& normal);

  Bounds3 bounds(uint32_t) const override { return bounds_; }
  float area(uint32_t) const override { return area_; }
  std::optional<ShapeSample> sampleArea(uint32_t, const Vec2& u) const override;
  std::optional<ShapeSample> sampleSolidAngle(uint32_t, const Vec3& from,
                                              const Vec2& u) const override;
  float pdfSolidAngle(uint32_t, const Vec3& from, const Vec3& p, const Vec3& n) const override;
  NormalCone normalCone(uint32_t) const override { return {normal_, 1}; }

 private:
  struct View;
  struct Halves;
  Parallelogram() = default;
  /// corner + s e1 + t e2.
  void set(ShapeSample& out, const Vec2& st, float pdf) const;

  glm::dvec3 corner_{0}, e1_{0}, e2_{0}, areaNormal_{0};
  Vec3 normal_{0}, gap_{0};  ///< gap: how far the fourth corner is off
  float area_ = 0;
  Bounds3 bounds_;
};

}  // namespace lampyris
