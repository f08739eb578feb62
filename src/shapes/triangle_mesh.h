// SPDX-License-Identifier: Apache-2.0
/// Triangle meshes: the shape behind trianglemesh, plymesh and loopsubdiv.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "base/shape.h"
#include "core/prefetch.h"

namespace lampyris {

/// Arrays of a mesh, in object space. `normals`, `tangents` and `uvs` are empty or one a vertex.
struct TriangleMeshData {
  std::vector<uint32_t> indices;  ///< three a triangle
  std::vector<Vec3> positions;
  std::vector<Vec3> normals;
  std::vector<Vec3> tangents;
  std::vector<Vec2> uvs;
};

/// Conventions of pbrt-v3 for uv, tangents and orientation. Vertices are kept in world space, once;
/// there is no object per triangle. ShapeHit::uv is (b1, b2).
class TriangleMesh final : public Shape {
 public:
  /// `data` must be consistent: see makeTriangleMesh.
  TriangleMesh(TriangleMeshData data, const Transform& objectToWorld, bool reverseOrientation);

  uint32_t elementCount() const override { return static_cast<uint32_t>(triangleCount()); }
  /// The storage of `positions` is readable one element beyond vertexCount, as Embree's 16-byte
  /// loads of the last vertex want it.
  TriangleBuffers triangles() const override {
    return {data_.positions.data(), vertexCount_, data_.indices.data(), triangleCount()};
  }
  Bounds3 bounds(uint32_t element) const override;
  /// For tests and callers without a ray tracer; in double precision.
  std::optional<ShapeHit> intersect(uint32_t element, const Ray& ray) const override;
  void prefetch(uint32_t element) const override {
    prefetchLine(&data_.indices[3 * static_cast<size_t>(element)]);
  }
  void surface(uint32_t element, const ShapeHit& hit, const Ray& ray, SurfaceDetail detail,
               SurfaceInteraction& out) const override;
  float area(uint32_t element) const override;
  std::optional<ShapeSample> sampleArea(uint32_t element, const Vec2& u) const override;
  std::optional<ShapeHit> locate(uint32_t element, const Vec3& p, const Vec3& n) const override;
  /// Uniform by solid angle where the triangle is large against its distance from `from`, else by
  /// area; which of the two is a function of `from` and the triangle alone.
  std::optional<ShapeSample> sampleSolidAngle(uint32_t element, const Vec3& from,
                                              const Vec2& u) const override;
  float pdfSolidAngle(uint32_t element, const Vec3& from, const Vec3& p,
                      const Vec3& n) const override;
  NormalCone normalCone(uint32_t element) const override;
  /// A parallelogram of two triangles.
  std::unique_ptr<const SampledSurface> whole() const override;

  const TriangleMeshData& data() const { return data_; }  ///< positions: with the padding element
  size_t vertexCount() const { return vertexCount_; }

 private:
  struct Corners;
  struct View;
  size_t triangleCount() const { return data_.indices.size() / 3; }
  Corners corners(uint32_t element) const;
  std::array<Vec2, 3> uvs(const Corners& c) const;
  Vec3 interpolatedNormal(const Corners& c, const Vec3& b) const;
  Vec3 orientedNormal(const glm::dvec3& areaNormal, const Vec3& vertexNormal) const;
  struct Parameters;
  Parameters parameters(const Corners& c, const Vec3& b, const glm::dvec3& areaNormal) const;
  void setShadingFrame(const Corners& c, const Vec3& b, const Vec3& vertexNormal,
                       SurfaceInteraction& out) const;
  void setNormalDerivatives(const Corners& c, const Vec3& vertexNormal,
                            SurfaceInteraction& out) const;

  TriangleMeshData data_;
  size_t vertexCount_;
  bool reverse_, flip_;
};

/// Checks `data` and makes the mesh. Throws SceneError (at context.location, naming `source`): no
/// triangles, an index that is no vertex, counts that do not fit, positions that are not finite.
/// Normals, tangents and uv that are not finite count as absent (0), with a warning.
std::unique_ptr<Shape> makeTriangleMesh(TriangleMeshData data, const ShapeContext& context,
                                        const std::string& source);

/// Converts the indices of a scene file. Throws SceneError on negative ones and on a count that is
/// no multiple of 3.
std::vector<uint32_t> toIndices(const std::vector<int>& indices, const ShapeContext& context,
                                const std::string& source);

}  // namespace lampyris
