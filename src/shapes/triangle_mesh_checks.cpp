// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <limits>

#include "shapes/triangle_mesh.h"

namespace lampyris {

namespace {

bool isFinite(const Vec2& v) { return std::isfinite(v.x) && std::isfinite(v.y); }

/// Sets what is not finite to zero, which counts as absent; says how many there were.
template <class V>
void dropNonFinite(std::vector<V>& values, const char* name, const ShapeContext& context,
                   const std::string& source) {
  size_t bad = 0;
  for (V& v : values) {
    if (isFinite(v)) continue;
    v = V(0);
    ++bad;
  }
  if (bad)
    context.diagnostics.warn(
        context.location, fmt::format("{}: {} of {} values of {} are not finite and are not used",
                                      source, bad, values.size(), name));
}

template <class V>
void checkCount(const std::vector<V>& values, const char* name, size_t vertices,
                const ShapeContext& context, const std::string& source) {
  if (values.empty() || values.size() == vertices) return;
  throw SceneError(context.location, fmt::format("{}: {} values of {} for {} vertices; give one a "
                                                 "vertex or leave them out",
                                                 source, values.size(), name, vertices));
}

}  // namespace

std::vector<uint32_t> toIndices(const std::vector<int>& indices, const ShapeContext& context,
                                const std::string& source) {
  if (indices.size() % 3)
    throw SceneError(
        context.location,
        fmt::format("{}: {} indices are not whole triangles; a multiple of 3 is wanted", source,
                    indices.size()));
  for (const int i : indices)
    if (i < 0)
      throw SceneError(context.location,
                       fmt::format("{}: index {} is negative; indices count from 0", source, i));
  return {indices.begin(), indices.end()};
}

std::unique_ptr<Shape> makeTriangleMesh(TriangleMeshData data, const ShapeContext& context,
                                        const std::string& source) {
  const size_t vertices = data.positions.size();
  const auto fail = [&](const std::string& why) {
    throw SceneError(context.location, source + ": " + why);
  };
  if (vertices == 0) fail("there are no vertex positions (\"point P\")");
  if (data.indices.empty()) fail("there are no triangles (\"integer indices\")");
  if (vertices > std::numeric_limits<uint32_t>::max() ||
      data.indices.size() / 3 > std::numeric_limits<uint32_t>::max())
    fail("more than 4294967295 vertices or triangles; split the mesh");
  for (const uint32_t i : data.indices)
    if (i >= vertices)
      fail(fmt::format("index {} is beyond the mesh's {} vertices (0 to {})", i, vertices,
                       vertices - 1));
  checkCount(data.normals, "N", vertices, context, source);
  checkCount(data.tangents, "S", vertices, context, source);
  if (data.uvs.size() > vertices) {
    context.diagnostics.warn(context.location,
                             fmt::format("{}: {} uv for {} vertices; the rest is not used", source,
                                         data.uvs.size(), vertices));
    data.uvs.resize(vertices);
  }
  checkCount(data.uvs, "uv", vertices, context, source);
  for (size_t i = 0; i < vertices; ++i)
    if (!lampyris::isFinite(context.objectToWorld.point(data.positions[i])))
      fail(fmt::format("the position of vertex {} is not finite", i));
  dropNonFinite(data.normals, "N", context, source);
  dropNonFinite(data.tangents, "S", context, source);
  dropNonFinite(data.uvs, "uv", context, source);
  return std::make_unique<TriangleMesh>(std::move(data), context.objectToWorld,
                                        context.reverseOrientation);
}

}  // namespace lampyris
