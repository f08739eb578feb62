// SPDX-License-Identifier: Apache-2.0
#include "shapes/ply_writer.h"

#include <fmt/format.h>

#include <bit>

#include "core/atomic_file.h"

namespace lampyris {

namespace {

static_assert(std::endian::native == std::endian::little);

template <class T>
void append(std::string& bytes, const T& value) {
  bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

std::string headerOf(const TriangleMeshData& mesh) {
  std::string h = fmt::format("ply\nformat binary_little_endian 1.0\nelement vertex {}\n",
                              mesh.positions.size());
  const auto properties = [&h](std::initializer_list<const char*> names) {
    for (const char* n : names) h += fmt::format("property float {}\n", n);
  };
  properties({"x", "y", "z"});
  if (!mesh.normals.empty()) properties({"nx", "ny", "nz"});
  if (!mesh.uvs.empty()) properties({"u", "v"});
  return h + fmt::format("element face {}\nproperty list uchar int vertex_indices\nend_header\n",
                         mesh.indices.size() / 3);
}

}  // namespace

void writePly(const std::string& path, const TriangleMeshData& mesh) {
  std::string bytes = headerOf(mesh);
  for (size_t v = 0; v < mesh.positions.size(); ++v) {
    append(bytes, mesh.positions[v]);
    if (!mesh.normals.empty()) append(bytes, mesh.normals[v]);
    if (!mesh.uvs.empty()) append(bytes, mesh.uvs[v]);
  }
  for (size_t i = 0; i + 2 < mesh.indices.size(); i += 3) {
    append(bytes, uint8_t{3});
    for (size_t k = 0; k < 3; ++k) append(bytes, mesh.indices[i + k]);
  }
  AtomicFile file(path);
  file.write(bytes.data(), bytes.size());
  file.commit();
}

}  // namespace lampyris
