// SPDX-License-Identifier: Apache-2.0
#include "shapes/ply_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>

#include "shapes/ply_reader.h"

namespace lampyris {

namespace {

[[noreturn]] void fail(const std::string& why) { throw std::runtime_error(why); }

/// Where a vertex property's values go: `stride` floats apart. Null: not wanted.
struct Target {
  float* values = nullptr;
  size_t stride = 0;
};

/// The least bytes that a row of the element takes.
uint64_t leastRowSize(const PlyElement& e, const PlyReader& in) {
  uint64_t size = 0;
  for (const PlyProperty& p : e.properties) size += in.leastSize(p.isList ? p.countType : p.type);
  return size;
}

/// Refuses a count that the file is too short for before anything is allocated by it.
void checkCount(const PlyElement& e, const PlyReader& in) {
  const uint64_t row = leastRowSize(e, in);
  if (row > 0 && e.count > (in.remaining() + 1) / row) PlyReader::endOfData();
}

void skipElement(const PlyElement& e, PlyReader& in) {
  if (e.properties.empty()) return;
  checkCount(e, in);
  const bool lists = std::any_of(e.properties.begin(), e.properties.end(),
                                 [](const PlyProperty& p) { return p.isList; });
  if (!lists && !in.ascii()) return in.skip(e.count * leastRowSize(e, in));
  for (uint64_t row = 0; row < e.count; ++row)
    for (const PlyProperty& p : e.properties) in.skipValues(p.type, p.isList ? in.nextCount(p) : 1);
}

/// Binary rows of one size: column by column, without a decision per value.
void readColumns(const PlyElement& e, const std::vector<Target>& targets, PlyReader& in) {
  const size_t row = leastRowSize(e, in);
  const char* const data = in.position();
  in.skip(e.count * row);
  size_t offset = 0;
  for (size_t i = 0; i < e.properties.size(); ++i) {
    const PlyType type = e.properties[i].type;
    if (float* out = targets[i].values) {
      plyDispatch(type, [&]<class T>(T) {
        const char* from = data + offset;
        for (uint64_t n = 0; n < e.count; ++n, from += row, out += targets[i].stride)
          *out = static_cast<float>(plyLoad<T>(from, in.swap()));
      });
    }
    offset += plySize(type);
  }
}

void readRows(const PlyElement& e, const std::vector<Target>& targets, PlyReader& in) {
  for (uint64_t row = 0; row < e.count; ++row) {
    for (size_t i = 0; i < e.properties.size(); ++i) {
      const PlyProperty& p = e.properties[i];
      if (p.isList) {
        in.skipValues(p.type, in.nextCount(p));
      } else {
        const double v = in.next(p.type);
        if (targets[i].values) targets[i].values[row * targets[i].stride] = static_cast<float>(v);
      }
    }
  }
}

/// Lets the named scalar properties go to consecutive floats of V; false if one is missing.
template <class V>
bool bind(const PlyElement& e, std::initializer_list<std::string_view> names, std::vector<V>& out,
          std::vector<Target>& targets) {
  for (const std::string_view name : names) {
    const int i = e.find(name);
    if (i < 0 || e.properties[static_cast<size_t>(i)].isList) return false;
  }
  out.resize(e.count);
  size_t component = 0;
  for (const std::string_view name : names) {
    Target& t = targets[static_cast<size_t>(e.find(name))];
    t = {reinterpret_cast<float*>(out.data()) + component++, sizeof(V) / sizeof(float)};
  }
  return true;
}

void readVertices(const PlyElement& e, PlyReader& in, TriangleMeshData& data) {
  checkCount(e, in);
  if (e.count == 0) fail("it has no vertices");
  if (e.count > std::numeric_limits<uint32_t>::max()) fail("it has more than 4294967295 vertices");
  std::vector<Target> targets(e.properties.size());
  if (!bind(e, {"x", "y", "z"}, data.positions, targets))
    fail("its element \"vertex\" lacks one of the properties x, y, z");
  bind(e, {"nx", "ny", "nz"}, data.normals, targets);
  (void)(bind(e, {"u", "v"}, data.uvs, targets) || bind(e, {"s", "t"}, data.uvs, targets) ||
         bind(e, {"texture_u", "texture_v"}, data.uvs, targets) ||
         bind(e, {"texture_s", "texture_t"}, data.uvs, targets));
  const bool lists = std::any_of(e.properties.begin(), e.properties.end(),
                                 [](const PlyProperty& p) { return p.isList; });
  if (lists || in.ascii())
    readRows(e, targets, in);
  else
    readColumns(e, targets, in);
}

/// Appends a polygon's triangles.
void addPolygon(const std::vector<uint32_t>& corners, PlyMesh& mesh) {
  auto& out = mesh.data.indices;
  const size_t n = corners.size();
  if (n < 3) {
    ++mesh.droppedFaces;
  } else if (n == 4) {
    out.insert(out.end(), {corners[0], corners[1], corners[2], corners[3], corners[0], corners[2]});
  } else {
    for (size_t i = 2; i < n; ++i) out.insert(out.end(), {corners[0], corners[i - 1], corners[i]});
  }
}

uint32_t toIndex(double v, uint64_t vertices) {
  if (!(v >= 0 && v < static_cast<double>(vertices)) || v != std::floor(v))
    fail(fmt::format("a face names vertex {}, but the vertices are 0 to {}", v, vertices - 1));
  return static_cast<uint32_t>(v);
}

void readFaces(const PlyElement& e, uint64_t vertices, PlyReader& in, PlyMesh& mesh) {
  int index = e.find("vertex_indices");
  if (index < 0) index = e.find("vertex_index");
  if (index < 0 || !e.properties[static_cast<size_t>(index)].isList)
    fail("its element \"face\" has no list \"vertex_indices\"");
  checkCount(e, in);
  mesh.data.indices.reserve(3 * e.count);
  std::vector<uint32_t> corners;
  for (uint64_t row = 0; row < e.count; ++row) {
    for (size_t i = 0; i < e.properties.size(); ++i) {
      const PlyProperty& p = e.properties[i];
      const size_t n = p.isList ? in.nextCount(p) : 1;
      if (static_cast<int>(i) != index) {
        in.skipValues(p.type, n);
        continue;
      }
      corners.resize(n);
      if (p.type == PlyType::Int32 && !in.ascii()) {
        const char* from = in.position();
        in.skip(n * sizeof(int32_t));
        for (uint32_t& c : corners) {
          const auto v = plyLoad<int32_t>(from, in.swap());
          c = static_cast<uint64_t>(v) < vertices ? static_cast<uint32_t>(v) : toIndex(v, vertices);
          from += sizeof(int32_t);
        }
      } else {
        for (uint32_t& c : corners) c = toIndex(in.next(p.type), vertices);
      }
    }
    addPolygon(corners, mesh);
  }
}

}  // namespace

PlyMesh parsePly(std::string_view file) {
  const PlyHeader header = parsePlyHeader(file);
  const PlyElement* vertex = header.find("vertex");
  if (!vertex) fail("it has no element \"vertex\"");
  if (!header.find("face")) fail("it has no element \"face\", so no surface");
  PlyReader in(file.substr(header.dataOffset), header.format);
  PlyMesh mesh;
  for (const PlyElement& e : header.elements) {
    if (e.name == "vertex")
      readVertices(e, in, mesh.data);
    else if (e.name == "face")
      readFaces(e, vertex->count, in, mesh);
    else
      skipElement(e, in);
  }
  return mesh;
}

}  // namespace lampyris
