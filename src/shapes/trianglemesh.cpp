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
    d.add("indices", indices, "Three vertex numbers a triangle, from 0.");
    d.add("P", positions, "Vertex positions.");
    d.add("N", normals, "Vertex normals, for smooth shading.").type(ParameterType::Normal);
    d.add("S", tangents, "Vertex tangents.").type(ParameterType::Vector3);
    d.add("uv", uvs, "Texture coordinates of the vertices (point2 or float).")
        .alias("st")
        .defaultIs("(0,0), (1,0), (1,1) for each triangle");
    d.add("alpha", alpha, "Rays pass where it is 0.");
    d.add("shadowalpha", shadowAlpha, "The same for shadow rays only.");
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
