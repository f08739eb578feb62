// SPDX-License-Identifier: Apache-2.0
/// Emission that varies over a surface, and what each element of the shape has of it.
#pragma once

#include <memory>
#include <vector>

#include "base/light.h"
#include "lights/emission_image.h"
#include "lights/picture_means.h"

namespace lampyris {

/// Memory: one float an element.
class SurfaceEmission {
 public:
  /// A texture times `scale`; negative values and values that are not finite count as black. Means
  /// are estimated by stratified points and are at least 1% of the shape's mean, for points may
  /// miss what is bright.
  SurfaceEmission(const Shape& shape, const SpectrumTexture& texture, const Rgb& scale);
  /// A picture times `scale`, looked up at (u, 1 − v). Means of triangles are found by their
  /// coverage, with `means` made of the same picture and scale: 0 where nothing is emitted.
  SurfaceEmission(const Shape& shape, std::shared_ptr<const EmissionImage> picture,
                  const Rgb& scale, const PictureMeans& means);

  /// Radiance at a point of the surface. By place alone: differentials don't count, so that all
  /// who ask see the same light.
  Rgb at(const SurfaceInteraction& hit) const { return valueAt(hit.p, hit.uv); }
  /// The same at a point that the shape's sampling returned.
  Rgb at(uint32_t element, const Vec3& p, const Vec3& n) const;
  /// Luminance, mean over an element.
  float meanLuminance(uint32_t element) const { return means_[element]; }

 private:
  Rgb valueAt(const Vec3& p, const Vec2& uv) const;
  float estimateMean(uint32_t element, int side) const;
  /// `otherwise` stands for the shape's mean where all points are black.
  void estimateMeans(float otherwise);

  const Shape& shape_;
  const SpectrumTexture* texture_ = nullptr;
  std::shared_ptr<const EmissionImage> picture_;
  Rgb scale_;
  std::vector<float> means_;
};

}  // namespace lampyris
