// SPDX-License-Identifier: Apache-2.0
// After magic number and version, a part's header is a list of attributes (name, type, size,
// value) that ends with an empty name; a file of many parts ends them with an empty header.
#include "core/exr_header.h"

#include <algorithm>
#include <cstdint>
#include <cstring>

#include "core/image_formats.h"

namespace lampyris {

namespace {

/// What is left of a list of values; all fail where it is too short.
class Cursor {
 public:
  Cursor(const std::string& path, std::string_view rest) : path_(path), rest_(rest) {}

  bool empty() const { return rest_.empty(); }
  size_t size() const { return rest_.size(); }
  std::string_view bytes(int64_t count) {
    if (count < 0 || static_cast<uint64_t>(count) > rest_.size()) fail();
    const std::string_view taken = rest_.substr(0, static_cast<size_t>(count));
    rest_.remove_prefix(taken.size());
    return taken;
  }
  int32_t integer() {
    int32_t value = 0;
    std::memcpy(&value, bytes(sizeof value).data(), sizeof value);
    return value;
  }
  /// Up to a byte of 0, which is taken too.
  std::string_view name() {
    const size_t end = rest_.find('\0');
    if (end == std::string_view::npos) fail();
    const std::string_view taken = bytes(static_cast<int64_t>(end));
    bytes(1);
    return taken;
  }
  [[noreturn]] void fail() const {
    failImageRead(path_, "its header is damaged, or the file is truncated");
  }

 private:
  const std::string& path_;
  std::string_view rest_;
};

/// The part of a header that decides how much memory the pixels take.
struct Layout {
  int64_t width = 0, height = 0, channels = 0;
};

/// The library reads as many bytes of these types as they should have, not as the file says, and
/// what it then takes for the next attribute may have any size.
void checkSize(std::string_view type, const Cursor& value) {
  struct Type {
    std::string_view name;
    size_t size;
  };
  static constexpr Type kTypes[] = {{"box2f", 16},      {"box2i", 16},   {"chromaticities", 32},
                                    {"compression", 1}, {"double", 8},   {"envmap", 1},
                                    {"float", 4},       {"int", 4},      {"keycode", 28},
                                    {"lineOrder", 1},   {"m33d", 72},    {"m33f", 36},
                                    {"m44d", 128},      {"m44f", 64},    {"rational", 8},
                                    {"tiledesc", 9},    {"timecode", 8}, {"v2d", 16},
                                    {"v2f", 8},         {"v2i", 8},      {"v3d", 24},
                                    {"v3f", 12},        {"v3i", 12},     {"deepImageState", 1}};
  for (const Type& t : kTypes)
    if (t.name == type && t.size != value.size()) value.fail();
}

void readAttribute(std::string_view name, std::string_view type, Cursor value, Layout& layout) {
  checkSize(type, value);
  if (name == "dataWindow" && type == "box2i") {
    const int64_t x0 = value.integer(), y0 = value.integer();
    layout.width = value.integer() - x0 + 1;
    layout.height = value.integer() - y0 + 1;
  } else if (type == "chlist") {
    constexpr int64_t kChannelBytes = 16;
    for (; !value.name().empty(); ++layout.channels) value.bytes(kChannelBytes);
    if (!value.empty()) value.fail();
  } else if (type == "preview") {
    const int64_t width = value.integer(), height = value.integer();
    if (width < 0 || height < 0 || width * height > kMaxImagePixels) value.fail();
    value.bytes(4 * width * height);
    if (!value.empty()) value.fail();
  } else if (type == "stringvector") {
    while (!value.empty()) value.bytes(value.integer());
  } else if (type == "floatvector") {
    if (value.size() % sizeof(float)) value.fail();
  } else if (type == "idmanifest") {
    value.fail();  // of deep images, which are not read
  }
}

void checkLayout(const std::string& path, const Layout& layout, size_t fileSize) {
  // Chunks have up to kChunkRows rows, whatever the height.
  constexpr int64_t kChunkRows = 256, kLargestValue = 4;
  checkImageSize(path, layout.width, layout.height);
  const auto pixels = static_cast<double>(layout.width * std::max(layout.height, kChunkRows));
  if (pixels * static_cast<double>(layout.channels * kLargestValue) >
      static_cast<double>(kMaxExrRatio) * static_cast<double>(fileSize))
    failImageRead(path, "the file is truncated, or its size is wrong");
}

}  // namespace

void checkExrHeaders(const std::string& path, std::string_view bytes) {
  constexpr int kMultiPart = 0x1000;
  if (!bytes.starts_with("\x76\x2f\x31\x01")) failImageRead(path, "the file is no EXR image");
  Cursor in(path, bytes.substr(4));
  const bool multiPart = in.integer() & kMultiPart;
  std::string_view name = in.name();
  do {
    Layout layout;
    for (; !name.empty(); name = in.name()) {
      const std::string_view type = in.name();
      readAttribute(name, type, Cursor(path, in.bytes(in.integer())), layout);
    }
    checkLayout(path, layout, bytes.size());
    if (multiPart) name = in.name();
  } while (!name.empty());
}

}  // namespace lampyris
