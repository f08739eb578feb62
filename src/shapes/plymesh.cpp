// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "core/source.h"
#include "shapes/ply_file.h"
#include "shapes/registry.h"

namespace lampyris {

namespace {

struct PlyMeshParameters {
  std::string filename;
  std::optional<FloatInput> alpha, shadowAlpha;

  void declare(Declaration& d) {
    d.add("filename", filename, "The PLY file.").rangeIs("any file name");
    d.add("alpha", alpha, "Rays pass where it is 0.").any();
    d.add("shadowalpha", shadowAlpha, "The same for shadow rays only.").any();
  }
};

std::unique_ptr<Shape> create(const PlyMeshParameters& p, const ShapeContext& context) {
  if (p.filename.empty())
    throw SceneError(context.location, "plymesh: \"string filename\" is missing");
  const std::string path = context.resolvePath(p.filename);
  const MappedFile file(path);
  PlyMesh mesh;
  try {
    mesh = parsePly(file.text());
  } catch (const std::runtime_error& e) {
    throw SceneError(context.location,
                     fmt::format("{}: {}; export the mesh again, or leave it out", path, e.what()));
  }
  if (mesh.droppedFaces)
    context.diagnostics.warn(context.location,
                             fmt::format("{}: {} faces have fewer than 3 vertices and are left out",
                                         path, mesh.droppedFaces));
  return makeTriangleMesh(std::move(mesh.data), context, path);
}

}  // namespace

ShapeRegistry::Entry plymeshPlugin() {
  return makePlugin("plymesh", "Mesh of a PLY file.", create);
}

}  // namespace lampyris
