// SPDX-License-Identifier: Apache-2.0
/// Loop subdivision surfaces. OpenSubdiv refines the topology; the masks are pbrt-v3's: Warren's
/// weights (Warren 1995, "Subdivision Methods for Geometric Design") at vertices of other valence
/// than 6, where OpenSubdiv has Loop's own, and limit positions and tangents after Hoppe et al.
/// 1994
/// ("Piecewise Smooth Surface Reconstruction"). Corners of a boundary are not kept sharp. As in
/// pbrt-v3 normals point against the order of the vertices (to where that is clockwise).
#include <fmt/format.h>
#include <opensubdiv/far/topologyDescriptor.h>
#include <opensubdiv/far/topologyRefinerFactory.h>

#include <cmath>
#include <memory>

#include "core/memory.h"
#include "shapes/registry.h"
#include "shapes/triangle_mesh.h"

namespace lampyris {

namespace {

namespace Far = OpenSubdiv::Far;
using Level = Far::TopologyLevel;
using Far::Index;

struct LoopSubdivParameters {
  std::vector<int> indices;
  std::vector<Vec3> positions;
  int levels = 3;
  std::string scheme = "loop";

  void declare(Declaration& d) {
    d.add("indices", indices, "Three vertex numbers a triangle of the control mesh.")
        .rangeIs("0 to the last vertex; a multiple of 3 values");
    d.add("P", positions, "Vertices of the control mesh.").rangeIs("any, for each vertex");
    d.add("levels", levels, "How often triangles are split in four.").range(0, 15).alias("nlevels");
    d.add("scheme", scheme, "The subdivision scheme.").oneOf({"loop"});
  }
};

/// The neighbours of a vertex, counter-clockwise; on a boundary from one end to the other.
class Ring {
 public:
  /// Returns false where there is no ring: an isolated vertex, or sheets that meet.
  bool set(const Level& level, Index v) {
    vertices_.clear();
    if (level.IsVertexNonManifold(v) || level.GetVertexFaces(v).empty()) return false;
    const auto edges = level.GetVertexEdges(v);
    for (int i = 0; i < edges.size(); ++i) {
      const auto ends = level.GetEdgeVertices(edges[i]);
      vertices_.push_back(static_cast<size_t>(ends[0] == v ? ends[1] : ends[0]));
    }
    boundary_ = level.IsVertexBoundary(v);
    return true;
  }
  size_t size() const { return vertices_.size(); }
  size_t operator[](size_t i) const { return vertices_[i]; }
  bool boundary() const { return boundary_; }

  /// (1 − n w) p + w Σ ring inside, with `edge` as w over the two ends on a boundary.
  Vec3 blend(const std::vector<Vec3>& p, const Vec3& centre, float inside, float edge) const {
    if (boundary_)
      return (1 - 2 * edge) * centre + edge * (p[vertices_.front()] + p[vertices_.back()]);
    Vec3 sum(0);
    for (const size_t i : vertices_) sum += p[i];
    return (1 - static_cast<float>(size()) * inside) * centre + inside * sum;
  }

 private:
  std::vector<size_t> vertices_;
  bool boundary_ = false;
};

float vertexWeight(size_t valence) {
  return valence == 3 ? 3.f / 16 : 3.f / (8 * static_cast<float>(valence));
}
float limitWeight(size_t valence) {
  return 1 / (static_cast<float>(valence) + 3 / (8 * vertexWeight(valence)));
}

Index otherVertex(const Level& level, Index face, Index a, Index b) {
  const auto v = level.GetFaceVertices(face);
  for (int i = 0; i < v.size(); ++i)
    if (v[i] != a && v[i] != b) return v[i];
  return a;
}

/// Positions on the next level.
std::vector<Vec3> refine(const Level& level, int childVertices, const std::vector<Vec3>& p) {
  std::vector<Vec3> out(static_cast<size_t>(childVertices));
  Ring ring;
  for (Index v = 0; v < level.GetNumVertices(); ++v) {
    const Vec3& at = p[static_cast<size_t>(v)];
    const Index child = level.GetVertexChildVertex(v);
    if (child < 0) continue;
    out[static_cast<size_t>(child)] =
        ring.set(level, v) ? ring.blend(p, at, vertexWeight(ring.size()), 1.f / 8) : at;
  }
  for (Index e = 0; e < level.GetNumEdges(); ++e) {
    const Index child = level.GetEdgeChildVertex(e);
    if (child < 0) continue;
    const auto ends = level.GetEdgeVertices(e);
    const auto faces = level.GetEdgeFaces(e);
    const Vec3 sum = p[static_cast<size_t>(ends[0])] + p[static_cast<size_t>(ends[1])];
    Vec3& to = out[static_cast<size_t>(child)];
    if (faces.size() == 2 && !level.IsEdgeNonManifold(e)) {
      const auto a = static_cast<size_t>(otherVertex(level, faces[0], ends[0], ends[1]));
      const auto b = static_cast<size_t>(otherVertex(level, faces[1], ends[0], ends[1]));
      to = 3.f / 8 * sum + 1.f / 8 * (p[a] + p[b]);
    } else {
      to = 0.5f * sum;
    }
  }
  return out;
}

Vec3 interiorNormal(const Ring& ring, const std::vector<Vec3>& p) {
  Vec3 s(0), t(0);
  for (size_t i = 0; i < ring.size(); ++i) {
    const float angle = 2 * kPi * static_cast<float>(i) / static_cast<float>(ring.size());
    s += std::cos(angle) * p[ring[i]];
    t += std::sin(angle) * p[ring[i]];
  }
  return cross(t, s);
}

Vec3 boundaryNormal(const Ring& ring, const Vec3& at, const std::vector<Vec3>& p) {
  const size_t n = ring.size();
  const Vec3 along = p[ring[n - 1]] - p[ring[0]];
  Vec3 inward(0);
  if (n == 2) {
    inward = p[ring[0]] + p[ring[1]] - 2.f * at;
  } else if (n == 3) {
    inward = p[ring[1]] - at;
  } else if (n == 4) {
    inward = 2.f * (p[ring[1]] + p[ring[2]]) - p[ring[0]] - p[ring[3]] - 2.f * at;
  } else {
    const float theta = kPi / static_cast<float>(n - 1);
    inward = -std::sin(theta) * (p[ring[0]] + p[ring[n - 1]]);
    for (size_t k = 1; k + 1 < n; ++k)
      inward += (2 - 2 * std::cos(theta)) * std::sin(static_cast<float>(k) * theta) * p[ring[k]];
  }
  return cross(along, inward);
}

/// Moves the vertices of the last level to the limit surface and adds its normals.
void toLimit(const Level& level, TriangleMeshData& mesh) {
  std::vector<Vec3> limit = mesh.positions;
  Ring ring;
  for (Index v = 0; v < level.GetNumVertices(); ++v) {
    const auto i = static_cast<size_t>(v);
    if (ring.set(level, v))
      limit[i] = ring.blend(mesh.positions, mesh.positions[i], limitWeight(ring.size()), 1.f / 5);
  }
  mesh.positions = std::move(limit);
  mesh.normals.assign(mesh.positions.size(), Vec3(0));
  for (Index v = 0; v < level.GetNumVertices(); ++v) {
    const auto i = static_cast<size_t>(v);
    // Where sheets meet the normal stays 0: triangles there are shaded flat.
    if (ring.set(level, v))
      mesh.normals[i] = ring.boundary() ? boundaryNormal(ring, mesh.positions[i], mesh.positions)
                                        : interiorNormal(ring, mesh.positions);
  }
}

/// Leaves out triangles that name a vertex twice: they have no area, and no neighbours to speak of.
std::vector<int> properTriangles(const std::vector<int>& indices) {
  std::vector<int> out;
  out.reserve(indices.size());
  for (size_t i = 0; i + 2 < indices.size(); i += 3) {
    const int a = indices[i], b = indices[i + 1], c = indices[i + 2];
    if (a != b && b != c && c != a) out.insert(out.end(), {a, b, c});
  }
  return out;
}

std::unique_ptr<Far::TopologyRefiner> makeRefiner(const std::vector<int>& indices,
                                                  const LoopSubdivParameters& p,
                                                  const ShapeContext& context) {
  const std::vector<int> perFace(indices.size() / 3, 3);
  Far::TopologyDescriptor descriptor;
  descriptor.numVertices = static_cast<int>(p.positions.size());
  descriptor.numFaces = static_cast<int>(perFace.size());
  descriptor.numVertsPerFace = perFace.data();
  descriptor.vertIndicesPerFace = indices.data();
  using Factory = Far::TopologyRefinerFactory<Far::TopologyDescriptor>;
  std::unique_ptr<Far::TopologyRefiner> refiner(
      Factory::Create(descriptor, Factory::Options(OpenSubdiv::Sdc::SCHEME_LOOP)));
  if (!refiner)
    throw SceneError(
        context.location,
        "loopsubdiv: its triangles cannot be connected to a surface; an edge is shared "
        "by too many of them");
  Far::TopologyRefiner::UniformOptions options(p.levels);
  options.fullTopologyInLastLevel = true;
  refiner->RefineUniform(options);
  return refiner;
}

void checkControlMesh(const LoopSubdivParameters& p, size_t triangles,
                      const ShapeContext& context) {
  const auto fail = [&](const std::string& why) {
    throw SceneError(context.location, "loopsubdiv: " + why);
  };
  if (p.positions.empty()) fail("there are no vertex positions (\"point P\")");
  if (triangles == 0) fail("there are no triangles (\"integer indices\")");
  for (const int i : p.indices)
    if (static_cast<size_t>(i) >= p.positions.size())
      fail(fmt::format("index {} is beyond the mesh's {} vertices (0 to {})", i, p.positions.size(),
                       p.positions.size() - 1));
  const double refined = static_cast<double>(triangles) * std::pow(4., p.levels);
  constexpr double kMostTriangles = 1 << 28;
  if (refined > kMostTriangles)
    fail(fmt::format("{} levels would make {:.3g} triangles; the most is {:.3g}", p.levels, refined,
                     kMostTriangles));
  constexpr double kTriangleBytes = 250;  // measured, while OpenSubdiv refines
  expectMemory(kTriangleBytes * refined, fmt::format("subdivision into {:.3g} triangles", refined),
               context.location);
}

std::unique_ptr<Shape> create(const LoopSubdivParameters& p, const ShapeContext& context) {
  toIndices(p.indices, context, "loopsubdiv");
  const std::vector<int> indices = properTriangles(p.indices);
  checkControlMesh(p, indices.size() / 3, context);
  const auto refiner = makeRefiner(indices, p, context);
  const Level base = refiner->GetLevel(0);
  bool manifold = true;
  for (Index v = 0; v < base.GetNumVertices(); ++v)
    manifold = manifold && !base.IsVertexNonManifold(v);
  if (!manifold)
    context.diagnostics.warn(
        context.location,
        "loopsubdiv: sheets of the control mesh meet in a vertex or an edge, or "
        "neighbours are ordered differently; such vertices are not smoothed");
  TriangleMeshData mesh;
  mesh.positions = p.positions;
  for (int l = 0; l < p.levels; ++l)
    mesh.positions =
        refine(refiner->GetLevel(l), refiner->GetLevel(l + 1).GetNumVertices(), mesh.positions);
  const Level last = refiner->GetLevel(p.levels);
  mesh.indices.reserve(3 * static_cast<size_t>(last.GetNumFaces()));
  for (Index f = 0; f < last.GetNumFaces(); ++f) {
    const auto v = last.GetFaceVertices(f);
    for (int i = 0; i < 3; ++i) mesh.indices.push_back(static_cast<uint32_t>(v[i]));
  }
  toLimit(last, mesh);
  return makeTriangleMesh(std::move(mesh), context, "loopsubdiv");
}

}  // namespace

ShapeRegistry::Entry loopsubdivPlugin() {
  return makePlugin("loopsubdiv", "Loop subdivision surface of a triangle mesh.", create);
}

}  // namespace lampyris
