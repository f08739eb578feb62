// SPDX-License-Identifier: Apache-2.0
/// Shapes: geometry of one or many elements (the triangles of a mesh).
#pragma once

#include <memory>
#include <optional>

#include "base/interaction.h"
#include "base/sampled_surface.h"
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

/// Everything within `radius` of `center`.
struct Ball {
  Vec3 center{0};
  float radius = kInfinity;
};

/// All positions are in world space (for a shape of an object instance: in the space in which
/// ObjectBegin stood). Immutable and thread-safe.
class Shape : public SampledSurface {
 public:
  /// Not empty for a triangle mesh: Embree intersects it itself.
  virtual TriangleBuffers triangles() const { return {}; }
  /// A ball that contains the element, if one is much tighter than the box; else infinite. Lets
  /// rays pass by without a look at the shape.
  virtual Ball ball(uint32_t element) const { return (void)element, Ball{}; }
  /// The nearest hit with 0 < t < ray.tMax; not called for triangle meshes.
  virtual std::optional<ShapeHit> intersect(uint32_t element, const Ray& ray) const = 0;
  /// Fetches the beginning of what surface() will read of the element.
  virtual void prefetch(uint32_t element) const { (void)element; }
  /// Fills p, pError, n, uv, dpdu …, shading of `out` for a hit of `ray`.
  virtual void surface(uint32_t element, const ShapeHit& hit, const Ray& ray, SurfaceDetail detail,
                       SurfaceInteraction& out) const = 0;

  /// Where a point `p` (normal `n`) that a sample function returned lies on the element: what
  /// surface() takes. For emitters whose light varies, so that others need not carry it along. The
  /// default meets a short ray along `n`. None where rounding has put p beyond the edge.
  virtual std::optional<ShapeHit> locate(uint32_t element, const Vec3& p, const Vec3& n) const;
  /// All elements as one surface of one element, if that can be sampled as one. Refers to nothing.
  virtual std::unique_ptr<const SampledSurface> whole() const { return nullptr; }
};

struct ShapeContext : BuildContext {
  const TextureResolver& textures;
  Transform objectToWorld;
  bool reverseOrientation = false;
};

using ShapeRegistry = Registry<Shape, ShapeContext>;

}  // namespace lampyris
