// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include "shapes/grid_mesh.h"
#include "shapes/registry.h"
#include "shapes/triangle_mesh.h"

namespace lampyris {

namespace {

struct HeightfieldParameters {
  int nu = 0, nv = 0;
  std::vector<float> z;

  void declare(Declaration& d) {
    d.add("nu", nu, "Samples along x.").atLeast(2).defaultIs("required");
    d.add("nv", nv, "Samples along y.").atLeast(2).defaultIs("required");
    d.add("Pz", z, "Heights, nu × nv, row after row along x.").rangeIs("nu × nv values");
  }
};

std::unique_ptr<Shape> create(const HeightfieldParameters& p, const ShapeContext& context) {
  const std::string source = "heightfield";
  const size_t nu = static_cast<size_t>(p.nu), nv = static_cast<size_t>(p.nv);
  if (nu < 2 || nv < 2)
    throw SceneError(context.location,
                     "heightfield: \"integer nu\" and \"integer nv\" are missing: how many heights "
                     "there are along x and y");
  if (p.z.size() != nu * nv)
    throw SceneError(context.location,
                     fmt::format("heightfield: {} heights (\"float Pz\") for nu × nv = {}",
                                 p.z.size(), nu * nv));
  TriangleMeshData data;
  for (size_t y = 0; y < nv; ++y) {
    for (size_t x = 0; x < nu; ++x) {
      const Vec2 uv(static_cast<float>(x) / static_cast<float>(nu - 1),
                    static_cast<float>(y) / static_cast<float>(nv - 1));
      data.uvs.push_back(uv);
      data.positions.emplace_back(uv, p.z[y * nu + x]);
    }
  }
  data.indices = gridTriangles(nu, nv);
  return makeTriangleMesh(std::move(data), context, source);
}

}  // namespace

ShapeRegistry::Entry heightfieldPlugin() {
  return makePlugin("heightfield", "Heights over a grid on the unit square.", create);
}

}  // namespace lampyris
