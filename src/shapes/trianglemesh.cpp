// SPDX-License-Identifier: Apache-2.0
#include "shapes/registry.h"
#include "shapes/triangle_mesh.h"

namespace lampyris {

namespace {

struct TriangleMeshParameters {
  std::vector<int> indices;
  std::vector<Vec3> positions, normals, tangents;
  std::vector<Vec2> uvs;
  std::optional<FloatInput> alpha, shadowAlpha;

  void declare(Declaration& d) {
    d.add("indices", indices, "Three vertex numbers a triangle, from 0.")
        .rangeIs("0 to the last vertex; a multiple of 3 values");
    d.add("P", positions, "Vertex positions.").rangeIs("any, for each vertex");
    d.add("N", normals, "Vertex normals, for smooth shading.")
        .type(ParameterType::Normal)
        .rangeIs("any, for each vertex, or none");
    d.add("S", tangents, "Vertex tangents.")
        .type(ParameterType::Vector3)
        .rangeIs("any, for each vertex, or none");
    d.add("uv", uvs, "Texture coordinates of the vertices (point2 or float).")
        .alias("st")
        .defaultIs("(0,0), (1,0), (1,1) for each triangle")
        .rangeIs("any, for each vertex, or none");
    d.add("alpha", alpha, "Rays pass where it is 0.").any();
    d.add("shadowalpha", shadowAlpha, "The same for shadow rays only.").any();
    d.ignored("faceIndices", "only Ptex textures use them, which are not supported");
  }
};

std::unique_ptr<Shape> create(const TriangleMeshParameters& p, const ShapeContext& context) {
  const std::string source = "trianglemesh";
  TriangleMeshData data{toIndices(p.indices, context, source), p.positions, p.normals, p.tangents,
                        p.uvs};
  return makeTriangleMesh(std::move(data), context, source);
}

}  // namespace

ShapeRegistry::Entry trianglemeshPlugin() {
  return makePlugin("trianglemesh", "Triangles given by vertices and indices.", create);
}

}  // namespace lampyris
