// SPDX-License-Identifier: Apache-2.0
/// What lights need of a surface: places on it at random.
#pragma once

#include <optional>

#include "core/bounds.h"
#include "core/vector.h"

namespace lampyris {

/// A point on a shape, drawn at random.
struct ShapeSample {
  Vec3 p{0}, pError{0};
  Vec3 n{0, 0, 1};  ///< geometric normal, oriented as SurfaceInteraction::n
  float pdf = 0;    ///< by area, or by solid angle: see the function that returned it
};

/// Immutable and thread-safe. Positions are those of the shape that it belongs to.
class SampledSurface {
 public:
  virtual ~SampledSurface() = default;

  virtual uint32_t elementCount() const { return 1; }
  virtual Bounds3 bounds(uint32_t element) const = 0;
  /// Area of an element, exact to float precision; 0 for a degenerate one.
  virtual float area(uint32_t element) const = 0;
  /// A point of the element; pdf by area = pdfArea(element, n). Uniform but for curved shapes under
  /// non-uniform scaling. None if the area is 0.
  virtual std::optional<ShapeSample> sampleArea(uint32_t element, const Vec2& u) const = 0;
  /// The density by area with which sampleArea() draws a point with normal `n` (either side): 1 /
  /// area(element) unless the shape says otherwise; 0 if the area is 0.
  virtual float pdfArea(uint32_t element, const Vec3& n) const;
  /// A point of the element as seen from `from`, pdf by solid angle at `from`. May return points
  /// that face away. The default converts sampleArea(). None if there is nothing to see.
  virtual std::optional<ShapeSample> sampleSolidAngle(uint32_t element, const Vec3& from,
                                                      const Vec2& u) const;
  /// The density with which sampleSolidAngle(element, from, ·) draws the point `p` (normal `n`) of
  /// the element; equal to what sampleSolidAngle reports for it.
  virtual float pdfSolidAngle(uint32_t element, const Vec3& from, const Vec3& p,
                              const Vec3& n) const;
  /// Bounds of the element's normals: axis and cosine of the largest deviation (−1: anything).
  struct NormalCone {
    Vec3 axis{0, 0, 1};
    float cosTheta = -1;
  };
  virtual NormalCone normalCone(uint32_t element) const = 0;
};

}  // namespace lampyris
