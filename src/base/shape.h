// SPDX-License-Identifier: Apache-2.0
/// Shapes: geometry of one or many elements (the triangles of a mesh).
#pragma once

#include <memory>
#include <optional>

#include "base/interaction.h"
#include "base/texture.h"
#include "core/bounds.h"
#include "core/registry.h"
#include "core/transform.h"

namespace lampyris {

/// Triangles as the ray tracer wants them; views into the shape.
struct TriangleBuffers {
  const Vec3* positions = nullptr;
  size_t vertexCount = 0;
  const uint32_t* indices = nullptr;  ///< three a triangle
  size_t triangleCount = 0;
};

/// Where a ray meets an element. `uv` is what Shape::surface takes back: barycentric (b1, b2) for
/// triangles as Embree reports them, the surface parameters (u, v) for all others.
struct ShapeHit {
  float t = 0;
  Vec2 uv{0};
};

/// A point on a shape, drawn at random.
struct ShapeSample {
  Vec3 p{0}, pError{0};
  Vec3 n{0, 0, 1};  ///< geometric normal, oriented as SurfaceInteraction::n
  float pdf = 0;    ///< by area, or by solid angle: see the function that returned it
};

/// Everything within `radius` of `center`.
struct Ball {
  Vec3 center{0};
  float radius = kInfinity;
};

/// All positions are in world space (for a shape of an object instance: in the space in which
/// ObjectBegin stood). Immutable and thread-safe.
class Shape {
 public:
  virtual ~Shape() = default;

  virtual uint32_t elementCount() const { return 1; }
  /// Not empty for a triangle mesh: Embree intersects it itself.
  virtual TriangleBuffers triangles() const { return {}; }
  virtual Bounds3 bounds(uint32_t element) const = 0;
  /// A ball that contains the element, if one is much tighter than the box; else infinite. Lets
  /// rays pass by without a look at the shape.
  virtual Ball ball(uint32_t element) const { return (void)element, Ball{}; }
  /// The nearest hit with 0 < t < ray.tMax; not called for triangle meshes.
  virtual std::optional<ShapeHit> intersect(uint32_t element, const Ray& ray) const = 0;
  /// Fills p, pError, n, uv, dpdu …, shading of `out` for a hit of `ray`.
  virtual void surface(uint32_t element, const ShapeHit& hit, const Ray& ray, SurfaceDetail detail,
                       SurfaceInteraction& out) const = 0;

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
  /// Where a point `p` (normal `n`) that a sample function returned lies on the element: what
  /// surface() takes. For emitters whose light varies, so that others need not carry it along. The
  /// default meets a short ray along `n`. None where rounding has put p beyond the edge.
  virtual std::optional<ShapeHit> locate(uint32_t element, const Vec3& p, const Vec3& n) const;
  /// Bounds of the element's normals: axis and cosine of the largest deviation (−1: anything).
  struct NormalCone {
    Vec3 axis{0, 0, 1};
    float cosTheta = -1;
  };
  virtual NormalCone normalCone(uint32_t element) const = 0;
};

struct ShapeContext : BuildContext {
  const TextureResolver& textures;
  Transform objectToWorld;
  bool reverseOrientation = false;
};

using ShapeRegistry = Registry<Shape, ShapeContext>;

}  // namespace lampyris
