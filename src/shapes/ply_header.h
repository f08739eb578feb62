// SPDX-License-Identifier: Apache-2.0
/// The header of a PLY file (Turk 1994, "The PLY Polygon File Format").
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace lampyris {

enum class PlyFormat : uint8_t { Ascii, LittleEndian, BigEndian };
enum class PlyType : uint8_t { Int8, Uint8, Int16, Uint16, Int32, Uint32, Float32, Float64 };

/// In bytes, in a binary file.
constexpr size_t plySize(PlyType t) {
  switch (t) {
    case PlyType::Int8:
    case PlyType::Uint8:
      return 1;
    case PlyType::Int16:
    case PlyType::Uint16:
      return 2;
    case PlyType::Int32:
    case PlyType::Uint32:
    case PlyType::Float32:
      return 4;
    case PlyType::Float64:
      return 8;
  }
  return 0;
}

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::Float32;
  bool isList = false;
  PlyType countType = PlyType::Uint8;  ///< of lists
};

struct PlyElement {
  std::string name;
  uint64_t count = 0;
  std::vector<PlyProperty> properties;

  /// Index of a property, or −1.
  int find(std::string_view property) const;
};

struct PlyHeader {
  PlyFormat format = PlyFormat::Ascii;
  std::vector<PlyElement> elements;  ///< in the order of their data
  size_t dataOffset = 0;             ///< in bytes

  const PlyElement* find(std::string_view element) const;
};

/// Throws std::runtime_error that says what is wrong.
PlyHeader parsePlyHeader(std::string_view file);

}  // namespace lampyris
