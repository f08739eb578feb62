// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <bit>
#include <filesystem>
#include <fstream>

#include "shapes/ply_file.h"
#include "shapes/shape_helpers.h"

namespace lampyris::test {
namespace {

enum class Format { Ascii, Little, Big };

/// Writes values in one of the three formats.
class Writer {
 public:
  explicit Writer(Format format) : format_(format) {
    const char* names[] = {"ascii", "binary_little_endian", "binary_big_endian"};
    header_ =
        fmt::format("ply\nformat {} 1.0\ncomment by a test\n", names[static_cast<int>(format)]);
  }
  Writer& line(const std::string& text) { return header_ += text + "\n", *this; }
  template <class T>
  Writer& add(T v) {
    if (format_ == Format::Ascii) {
      data_ += fmt::format("{} ", v);
      return *this;
    }
    auto bytes = std::bit_cast<std::array<char, sizeof(T)>>(v);
    if ((format_ == Format::Big) == (std::endian::native == std::endian::little))
      std::reverse(bytes.begin(), bytes.end());
    data_.append(bytes.data(), bytes.size());
    return *this;
  }
  std::string text() const { return header_ + "end_header\n" + data_; }

 private:
  Format format_;
  std::string header_, data_;
};

/// A square and a pentagon with properties and elements that nobody asked for.
std::string fullFile(Format format, bool doubles) {
  Writer w(format);
  const char* real = doubles ? "double" : "float32";
  w.line("element camera 2").line("property list uchar short views").line("property float f");
  w.line("element vertex 5").line("property uchar red");
  for (const char* name : {"ny", "x", "t", "y", "nx", "z", "nz", "s"})
    w.line(fmt::format("property {} {}", real, name));
  w.line("element face 3")
      .line("property uint8 flags")
      .line("property list uint8 int vertex_indices");
  w.line("property list ushort float weights").line("element edge 1").line("property int a");
  for (int i = 0; i < 2; ++i) w.add(uint8_t{2}).add(int16_t{1}).add(int16_t{-7}).add(0.5f);
  const auto value = [&](double v) { doubles ? w.add(v) : w.add(static_cast<float>(v)); };
  for (int i = 0; i < 5; ++i) {
    w.add(uint8_t{200});
    // ny x t y nx z nz s
    for (const double v : {0.25, i * 1.5, 10. + i, i * i * 0.5, 0., -1. * i, 1., 20. + i}) value(v);
  }
  const auto face = [&](std::initializer_list<int> corners) {
    w.add(uint8_t{9}).add(static_cast<uint8_t>(corners.size()));
    for (const int c : corners) w.add(int32_t{c});
    w.add(uint16_t{1}).add(0.25f);
  };
  face({0, 1, 2, 3});
  face({4, 3, 2, 1, 0});
  face({0, 1});
  w.add(int32_t{3});
  return w.text();
}

TEST(Ply, AllFormatsTypesAndOrders) {
  for (const Format format : {Format::Ascii, Format::Little, Format::Big}) {
    for (const bool doubles : {false, true}) {
      SCOPED_TRACE(static_cast<int>(format));
      const PlyMesh mesh = parsePly(fullFile(format, doubles));
      ASSERT_EQ(mesh.data.positions.size(), 5u);
      EXPECT_EQ(mesh.data.positions[3], Vec3(4.5f, 4.5f, -3));
      ASSERT_EQ(mesh.data.normals.size(), 5u);
      EXPECT_EQ(mesh.data.normals[2], Vec3(0, 0.25f, 1));
      ASSERT_EQ(mesh.data.uvs.size(), 5u);
      EXPECT_EQ(mesh.data.uvs[4], Vec2(24, 14));
      const std::vector<uint32_t> want = {0, 1, 2, 3, 0, 2, 4, 3, 2, 4, 2, 1, 4, 1, 0};
      EXPECT_EQ(mesh.data.indices, want);
      EXPECT_EQ(mesh.droppedFaces, 1u);
    }
  }
}

std::string simple(Format format, const std::string& uNames = "",
                   const char* index = "vertex_index", const char* indexType = "uint") {
  Writer w(format);
  w.line("element vertex 3")
      .line("property float x")
      .line("property float y")
      .line("property float z");
  if (!uNames.empty()) {
    const size_t blank = uNames.find(' ');
    w.line("property float " + uNames.substr(0, blank))
        .line("property float " + uNames.substr(blank + 1));
  }
  w.line("element face 1").line(fmt::format("property list int {} {}", indexType, index));
  for (int i = 0; i < 3; ++i) {
    w.add(static_cast<float>(i)).add(static_cast<float>(i * i)).add(0.f);
    if (!uNames.empty()) w.add(0.5f * static_cast<float>(i)).add(0.25f);
  }
  w.add(int32_t{3});
  for (int i = 0; i < 3; ++i) {
    if (std::string(indexType) == "uint") w.add(static_cast<uint32_t>(i));
    if (std::string(indexType) == "short") w.add(static_cast<int16_t>(i));
    if (std::string(indexType) == "uchar") w.add(static_cast<uint8_t>(i));
    if (std::string(indexType) == "double") w.add(static_cast<double>(i));
  }
  return w.text();
}

TEST(Ply, NamesOfUvAndIndices) {
  for (const Format format : {Format::Ascii, Format::Little, Format::Big}) {
    for (const char* names : {"u v", "s t", "texture_u texture_v", "texture_s texture_t"})
      EXPECT_EQ(parsePly(simple(format, names)).data.uvs.at(2), Vec2(1, 0.25f));
    for (const char* type : {"uint", "short", "uchar", "double"})
      EXPECT_EQ(parsePly(simple(format, "", "vertex_indices", type)).data.indices,
                (std::vector<uint32_t>{0, 1, 2}));
    EXPECT_TRUE(parsePly(simple(format, "u w")).data.uvs.empty());
  }
}

TEST(Ply, LineEndings) {
  std::string text = simple(Format::Ascii);
  std::string windows, old;
  for (const char c : text) {
    windows += c == '\n' ? "\r\n" : std::string(1, c);
    old += c == '\n' ? '\r' : c;
  }
  EXPECT_EQ(parsePly(windows).data.positions.size(), 3u);
  EXPECT_EQ(parsePly(old).data.positions.size(), 3u);
  // Binary data may begin with the bytes of a newline.
  Writer w(Format::Little);
  w.line("element vertex 3")
      .line("property uchar c")
      .line("property float x")
      .line("property float y");
  w.line("property float z")
      .line("element face 1")
      .line("property list uchar uchar vertex_indices");
  for (int i = 0; i < 3; ++i) w.add(uint8_t{'\n'}).add(7.f).add(static_cast<float>(i)).add(0.f);
  w.add(uint8_t{3}).add(uint8_t{0}).add(uint8_t{1}).add(uint8_t{2});
  EXPECT_EQ(parsePly(w.text()).data.positions[2], Vec3(7, 2, 0));
}

TEST(Ply, TruncatedFilesAreRefused) {
  for (const Format format : {Format::Ascii, Format::Little, Format::Big}) {
    const std::string text = fullFile(format, false);
    const size_t header = text.find("end_header");
    // ASCII may lose its last blank, and digits, unnoticed.
    const size_t whole = format == Format::Ascii ? text.size() - 3 : text.size() - 1;
    for (size_t n = 0; n <= whole; n += n < header ? 7 : 1)
      EXPECT_THROW(parsePly(std::string_view(text).substr(0, n)), std::runtime_error) << n;
  }
}

TEST(Ply, DamagedBytesNeverCrash) {
  for (const Format format : {Format::Ascii, Format::Little, Format::Big}) {
    const std::string text = fullFile(format, false);
    for (uint64_t i = 0; i < 4000; ++i) {
      std::string broken = text;
      for (uint32_t k = 0; k < 3; ++k) {
        const auto where =
            static_cast<size_t>(uniform(1, i, 2 * k) * static_cast<float>(text.size()));
        broken[where] = static_cast<char>(static_cast<int>(uniform(1, i, 2 * k + 1) * 256));
      }
      try {
        for (const uint32_t index : parsePly(broken).data.indices) ASSERT_LT(index, 1000u);
      } catch (const std::runtime_error&) {
      }
    }
  }
}

TEST(Ply, BrokenFilesAreRefused) {
  const std::string vertex =
      "element vertex 3\nproperty float x\nproperty float y\nproperty float z\n";
  const std::string face = "element face 1\nproperty list uchar int vertex_indices\n";
  const std::string data = "end_header\n0 0 0 1 0 0 0 1 0\n";
  const std::string begin = "ply\nformat ascii 1.0\n";
  const auto error = [](const std::string& text) -> std::string {
    try {
      parsePly(text);
    } catch (const std::runtime_error& e) {
      return e.what();
    }
    return "";
  };
  EXPECT_EQ(error(begin + vertex + face + data + "3 0 1 2"), "");
  const std::vector<std::pair<std::string, std::string>> cases = {
      {"", "no PLY file"},
      {"solid cube\n", "no PLY file"},
      {"ply\n" + vertex + face + data + "3 0 1 2", "format"},
      {"ply\nformat binary 1.0\n", "known format"},
      {begin + vertex + face, "does not end"},
      {begin + "garbage\nend_header\n", "unknown header line"},
      {begin + "element vertex -3\nend_header\n", "element"},
      {begin + "property float x\n" + vertex + face + data, "no element"},
      {begin + vertex + vertex + face + data, "twice"},
      {begin + "element vertex 3\nproperty quad x\n" + face + data, "unknown type"},
      {begin + vertex + "element face 1\nproperty list float int vertex_indices\n" + data,
       "no integer"},
      {begin + face + data, "\"vertex\""},
      {begin + vertex + data, "\"face\""},
      {begin + "element vertex 3\nproperty float x\nproperty float y\n" + face + data, "x, y, z"},
      {begin + vertex + "element face 1\nproperty list uchar int corners\n" + data,
       "vertex_indices"},
      {begin + "element vertex 0\nproperty float x\nproperty float y\nproperty float z\n" + face +
           data,
       "no vertices"},
      {begin +
           "element vertex 99999999999999\nproperty float x\nproperty float y\nproperty float z\n" +
           face + data,
       "truncated"},
      {begin +
           "element vertex 18446744073709551615\nproperty float x\nproperty float y\nproperty "
           "float z\n" +
           face + data,
       "truncated"},
      {begin + vertex + face + data + "-3 0 1 2", "negative"},
      {begin + vertex + face + data + "1e15 0 1 2", "truncated"},
      {begin + vertex + face + data + "3 0 1 3", "names vertex 3"},
      {begin + vertex + face + data + "3 0 1 -1", "names vertex -1"},
      {begin + vertex + face + data + "3 0 1 1.5", "names vertex 1.5"},
      {begin + vertex + face + data + "3 0 1 nan", "names vertex"},
      {begin + vertex + face + data + "3 0 x 1", "expected a number"},
      {begin + vertex + face + data + "3 0 1x 1", "expected a number"}};
  for (const auto& [text, part] : cases)
    EXPECT_NE(error(text).find(part), std::string::npos) << text << "\n->" << error(text);
  // An element without properties has no data, however many of it there are.
  EXPECT_EQ(
      error(begin + "element nothing 18446744073709551615\n" + vertex + face + data + "3 0 1 2"),
      "");
  // Numbers that no double holds.
  EXPECT_EQ(parsePly(begin + vertex + face + "end_header\n1e-400 +2 0 1e400 0 0 0 1 0\n3 0 1 2")
                .data.positions[0],
            Vec3(0, 2, 0));
}

TEST(Ply, TheShapeNamesTheFile) {
  const auto path =
      std::filesystem::temp_directory_path() / fmt::format("lampyris-{}.ply", ::getpid());
  const auto write = [&](const std::string& text) {
    std::ofstream(path, std::ios::binary) << text;
  };
  const Parameters p = Parameters().text("filename", path.string());
  write(fullFile(Format::Little, true));
  Build build;
  const auto mesh = build.make("plymesh", p, Transform::scale(Vec3(2)));
  EXPECT_EQ(mesh->elementCount(), 5u);
  EXPECT_EQ(build.warnings.size(), 1u);
  EXPECT_EQ(mesh->triangles().positions[3], Vec3(9, 9, -6));
  write(fullFile(Format::Little, true).substr(0, 500));
  try {
    build.make("plymesh", p);
    FAIL();
  } catch (const SceneError& e) {
    EXPECT_NE(std::string(e.what()).find(path.string()), std::string::npos);
  }
  std::filesystem::remove(path);
  try {
    build.make("plymesh", p);
    FAIL();
  } catch (const SceneError& e) {
    EXPECT_NE(std::string(e.what()).find(path.string()), std::string::npos);
  }
  EXPECT_THROW(build.make("plymesh", {}), SceneError);
}

}  // namespace
}  // namespace lampyris::test
