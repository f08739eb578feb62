// SPDX-License-Identifier: Apache-2.0
#include "shapes/ply_header.h"

#include <fmt/format.h>

#include <charconv>
#include <optional>
#include <stdexcept>

namespace lampyris {

namespace {

[[noreturn]] void fail(const std::string& why) { throw std::runtime_error(why); }

std::vector<std::string_view> words(std::string_view line) {
  std::vector<std::string_view> out;
  size_t i = 0;
  while (true) {
    i = line.find_first_not_of(" \t", i);
    if (i == std::string_view::npos) return out;
    const size_t end = std::min(line.find_first_of(" \t", i), line.size());
    out.push_back(line.substr(i, end - i));
    i = end;
  }
}

PlyType typeOf(std::string_view name, std::string_view line) {
  struct Spelling {
    std::string_view name;
    PlyType type;
  };
  static constexpr Spelling kSpellings[] = {
      {"char", PlyType::Int8},      {"int8", PlyType::Int8},       {"uchar", PlyType::Uint8},
      {"uint8", PlyType::Uint8},    {"short", PlyType::Int16},     {"int16", PlyType::Int16},
      {"ushort", PlyType::Uint16},  {"uint16", PlyType::Uint16},   {"int", PlyType::Int32},
      {"int32", PlyType::Int32},    {"uint", PlyType::Uint32},     {"uint32", PlyType::Uint32},
      {"float", PlyType::Float32},  {"float32", PlyType::Float32}, {"double", PlyType::Float64},
      {"float64", PlyType::Float64}};
  for (const Spelling& s : kSpellings)
    if (s.name == name) return s.type;
  fail(fmt::format("unknown type \"{}\" in the header line \"{}\"", name, line));
}

/// Takes lines off the front; the first line's ending is that of all, so that binary data that
/// starts with a newline's byte is not swallowed.
class Lines {
 public:
  explicit Lines(std::string_view file) : file_(file) {
    const size_t end = file.find_first_of("\r\n");
    if (end == std::string_view::npos) return;
    ending_ = file.substr(end, file[end] == '\r' && file.substr(end + 1, 1) == "\n" ? 2 : 1);
  }
  std::optional<std::string_view> next() {
    const size_t end = ending_.empty() ? std::string_view::npos : file_.find(ending_, offset_);
    if (end == std::string_view::npos) return std::nullopt;
    const std::string_view line = file_.substr(offset_, end - offset_);
    offset_ = end + ending_.size();
    return line;
  }
  size_t offset() const { return offset_; }

 private:
  std::string_view file_, ending_;
  size_t offset_ = 0;
};

PlyFormat formatOf(const std::vector<std::string_view>& w, std::string_view line) {
  if (w.size() == 3 && w[2] == "1.0") {
    if (w[1] == "ascii") return PlyFormat::Ascii;
    if (w[1] == "binary_little_endian") return PlyFormat::LittleEndian;
    if (w[1] == "binary_big_endian") return PlyFormat::BigEndian;
  }
  fail(
      fmt::format("\"{}\" is no known format (ascii, binary_little_endian or binary_big_endian, "
                  "version 1.0)",
                  line));
}

void addElement(const std::vector<std::string_view>& w, std::string_view line, PlyHeader& header) {
  PlyElement e;
  if (w.size() == 3) {
    e.name = w[1];
    const auto [end, error] = std::from_chars(w[2].begin(), w[2].end(), e.count);
    if (error == std::errc() && end == w[2].end()) {
      if (header.find(e.name)) fail(fmt::format("the element \"{}\" is declared twice", e.name));
      header.elements.push_back(std::move(e));
      return;
    }
  }
  fail(fmt::format("expected \"element <name> <count>\", got \"{}\"", line));
}

void addProperty(const std::vector<std::string_view>& w, std::string_view line, PlyHeader& header) {
  if (header.elements.empty()) fail(fmt::format("\"{}\" belongs to no element", line));
  PlyElement& element = header.elements.back();
  PlyProperty p;
  if (w.size() == 5 && w[1] == "list") {
    p.isList = true;
    p.countType = typeOf(w[2], line);
    if (p.countType == PlyType::Float32 || p.countType == PlyType::Float64)
      fail(fmt::format("the length of a list is no integer in \"{}\"", line));
    p.type = typeOf(w[3], line);
    p.name = w[4];
  } else if (w.size() == 3) {
    p.type = typeOf(w[1], line);
    p.name = w[2];
  } else {
    fail(fmt::format("expected \"property <type> <name>\", got \"{}\"", line));
  }
  if (element.find(p.name) >= 0)
    fail(fmt::format("the property \"{}\" of \"{}\" is declared twice", p.name, element.name));
  element.properties.push_back(std::move(p));
}

}  // namespace

int PlyElement::find(std::string_view property) const {
  for (size_t i = 0; i < properties.size(); ++i)
    if (properties[i].name == property) return static_cast<int>(i);
  return -1;
}

const PlyElement* PlyHeader::find(std::string_view element) const {
  for (const PlyElement& e : elements)
    if (e.name == element) return &e;
  return nullptr;
}

PlyHeader parsePlyHeader(std::string_view file) {
  Lines lines(file);
  if (lines.next() != "ply") fail("it is no PLY file (the first line must be \"ply\")");
  PlyHeader header;
  bool hasFormat = false;
  while (const auto line = lines.next()) {
    const auto w = words(*line);
    if (w.empty() || w[0] == "comment" || w[0] == "obj_info") continue;
    if (w[0] == "format") {
      header.format = formatOf(w, *line);
      hasFormat = true;
    } else if (w[0] == "element") {
      addElement(w, *line, header);
    } else if (w[0] == "property") {
      addProperty(w, *line, header);
    } else if (w[0] == "end_header") {
      if (!hasFormat) fail("the header has no \"format\" line");
      header.dataOffset = lines.offset();
      return header;
    } else {
      fail(fmt::format("unknown header line \"{}\"", line->substr(0, 80)));
    }
  }
  fail("the header does not end (\"end_header\" is missing)");
}

}  // namespace lampyris
