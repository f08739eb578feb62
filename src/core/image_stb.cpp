// SPDX-License-Identifier: Apache-2.0
// PNG, JPG, TGA, BMP and HDR files through stb.
#define STBI_NO_STDIO
#include <stb/stb_image.h>
#include <stb/stb_image_write.h>

#include <algorithm>
#include <climits>
#include <cmath>
#include <cstring>

#include "core/atomic_file.h"
#include "core/image_formats.h"
#include "core/image_stb_memory.h"

namespace lampyris {

namespace {

/// stb reads on past the end of a truncated file as if zeros followed, up to the last pixel of
/// whatever size the header claims. Here that is an exception, which leaves stb: StbMemory frees
/// what it holds. Its reads tell where the end was needed: it refills its buffer of `kStbBuffer`
/// bytes, where fewer are normal but none are not; all other reads want exactly what they ask for.
struct StbSource {
  static constexpr int kStbBuffer = 128;
  const std::string& path;
  std::string_view bytes;
  size_t at = 0;

  [[noreturn]] void failTruncated() const { failImageRead(path, "the file is truncated"); }

  static int read(void* user, char* data, int size) {
    auto& s = *static_cast<StbSource*>(user);
    const int n = static_cast<int>(std::min(s.bytes.size() - s.at, static_cast<size_t>(size)));
    if (n != size && (n == 0 || size != kStbBuffer)) s.failTruncated();
    std::memcpy(data, s.bytes.data() + s.at, static_cast<size_t>(n));
    s.at += static_cast<size_t>(n);
    return n;
  }
  static void skip(void* user, int n) {
    auto& s = *static_cast<StbSource*>(user);
    const int64_t to = static_cast<int64_t>(s.at) + n;
    if (to > static_cast<int64_t>(s.bytes.size())) s.failTruncated();
    s.at = static_cast<size_t>(std::max<int64_t>(to, 0));
  }
  static int atEnd(void* user) {
    const auto& s = *static_cast<StbSource*>(user);
    return s.at >= s.bytes.size();
  }
};

constexpr stbi_io_callbacks kCallbacks = {StbSource::read, StbSource::skip, StbSource::atEnd};

/// Goes through a JPG file's markers as stb does and refuses Huffman tables of more than 256 codes:
/// stb 2.27 writes beyond its arrays there.
class JpgTableCheck {
 public:
  explicit JpgTableCheck(std::string_view bytes) : bytes_(bytes) {}

  bool isSafe() {
    if (bytes_.empty() || bytes_[0] != '\xff' || nextMarker() != kStart) return true;  // no JPG
    while (at_ < bytes_.size()) {
      const int marker = nextMarker();
      if (marker == kEnd) break;
      if (marker == kHuffmanTables) {
        if (!tablesAreSafe()) return false;
      } else if (marker != 0 && !(marker >= kFirstRestart && marker <= kEnd)) {
        const int length = word();
        // After a JFIF segment of 7 bytes stb skips to an arbitrary place.
        if (length < 2 || (marker == kJfif && length == 7)) return false;
        at_ += static_cast<size_t>(length - 2);
      }
    }
    return true;
  }

 private:
  static constexpr int kHuffmanTables = 0xc4, kFirstRestart = 0xd0, kStart = 0xd8, kEnd = 0xd9,
                       kJfif = 0xe0, kPastEnd = 0x81;

  int byte() { return at_ < bytes_.size() ? static_cast<unsigned char>(bytes_[at_++]) : kPastEnd; }
  int word() {
    const int high = byte();
    return high << 8 | byte();
  }
  /// The byte after the next 0xff; 0 stands for a stuffed byte of image data.
  int nextMarker() {
    while (at_ < bytes_.size() && byte() != 0xff) {
    }
    int marker = byte();
    while (marker == 0xff) marker = byte();
    return marker;
  }
  bool tablesAreSafe() {
    for (int left = word() - 2; left > 0;) {
      byte();
      int codes = 0;
      for (int i = 0; i < 16; ++i) codes += byte();
      if (codes > 256) return false;
      at_ += static_cast<size_t>(codes);
      left -= 17 + codes;
    }
    return true;
  }

  std::string_view bytes_;
  size_t at_ = 0;
};

template <class Value>
Image toImage(const Value* values, int width, int height, int channels, float unit) {
  Image image(width, height, channels);
  std::vector<float>& data = image.data();
  for (size_t i = 0; i < data.size(); ++i) data[i] = static_cast<float>(values[i]) / unit;
  return image;
}

/// Loads with `loader` (one of stb's functions) and checks.
template <class Load>
Image load(const std::string& path, std::string_view bytes, const StbMemory& memory, Load&& loader,
           float unit) {
  StbSource source{path, bytes};
  int width = 0, height = 0, channels = 0;
  const auto* const pixels = loader(&source, &width, &height, &channels);
  if (!pixels && memory.wasRefused())
    failImageRead(path, "it is damaged: its size does not need the memory that it asks for");
  if (!pixels) failImageRead(path, stbi_failure_reason() ? stbi_failure_reason() : "damaged");
  return toImage(pixels, width, height, channels, unit);
}

bool isPng(std::string_view bytes) { return bytes.starts_with("\x89PNG"); }

int64_t maxPixelsPerByte(std::string_view bytes) {
  if (isPng(bytes)) return kMaxPixelsPerByte;
  return bytes.starts_with('\xff') ? kMaxJpgPixelsPerByte : kMaxOtherPixelsPerByte;
}

constexpr size_t kMemoryOfHeaders = 1 << 16;

/// More than stb needs for an image of this size; it rounds the sides of JPG images up to 32.
size_t memoryFor(int width, int height, std::string_view bytes) {
  constexpr size_t kPixel = 32;
  // JPG files are decoded by blocks; the rows of PNG files begin with a byte of their own.
  const size_t block = isPng(bytes) ? 1 : 32;
  const size_t pixels =
      (static_cast<size_t>(width) + block) * (static_cast<size_t>(height) + block);
  return kMemoryOfHeaders + 4 * bytes.size() + kPixel * pixels;
}

unsigned char toByte(float v) {
  return static_cast<unsigned char>(std::clamp(255 * (v > 0 ? v : 0) + 0.5f, 0.f, 255.f));
}

/// sRGB-encoded bytes; alpha stays linear.
std::vector<unsigned char> toBytes(const Image& image) {
  const std::vector<float>& data = image.data();
  const auto channels = static_cast<size_t>(image.channels());
  std::vector<unsigned char> bytes(data.size());
  for (size_t i = 0; i < data.size(); ++i) {
    const bool alpha = channels % 2 == 0 && i % channels == channels - 1;
    bytes[i] = toByte(alpha || !(data[i] > 0) ? data[i] : linearToSrgb(data[i]));
  }
  return bytes;
}

/// What shared exponents can hold: not negative, finite.
std::vector<float> toRgbe(const Image& image) {
  std::vector<float> values = image.data();
  for (float& v : values) v = v > 0 ? std::min(v, 1e38f) : 0.f;
  return values;
}

void append(void* user, void* data, int size) {
  static_cast<std::string*>(user)->append(static_cast<const char*>(data),
                                          static_cast<size_t>(size));
}

}  // namespace

LoadedImage readStbImage(const std::string& path, std::string_view bytes) {
  if (bytes.size() > INT_MAX) failImageRead(path, "files of 2 GB and more are not supported");
  if (!JpgTableCheck(bytes).isSafe()) failImageRead(path, "a damaged JPG file");
  StbMemory stbMemory(kMemoryOfHeaders);
  const auto* const memory = reinterpret_cast<const stbi_uc*>(bytes.data());
  const int size = static_cast<int>(bytes.size());
  int width = 0, height = 0, channels = 0;
  if (!stbi_info_from_memory(memory, size, &width, &height, &channels))
    failImageRead(path, "this is no PNG, JPG, TGA, BMP or HDR image, or it is damaged");
  checkImageSize(path, width, height);
  if (int64_t{width} * height > maxPixelsPerByte(bytes) * size)
    failImageRead(path, "the file is truncated, or its size is wrong");
  stbMemory.setLimit(memoryFor(width, height, bytes));

  if (stbi_is_hdr_from_memory(memory, size)) {
    const auto loader = [](StbSource* s, int* w, int* h, int* c) {
      return stbi_loadf_from_callbacks(&kCallbacks, s, w, h, c, 0);
    };
    return {load(path, bytes, stbMemory, loader, 1.f), false};
  }
  if (stbi_is_16_bit_from_memory(memory, size)) {
    const auto loader = [](StbSource* s, int* w, int* h, int* c) {
      return stbi_load_16_from_callbacks(&kCallbacks, s, w, h, c, 0);
    };
    return {load(path, bytes, stbMemory, loader, 65535.f), true};
  }
  const auto loader = [](StbSource* s, int* w, int* h, int* c) {
    return stbi_load_from_callbacks(&kCallbacks, s, w, h, c, 0);
  };
  return {load(path, bytes, stbMemory, loader, 255.f), true};
}

void writeStbImage(const std::string& path, const std::string& ending, const Image& image) {
  constexpr int kJpgQuality = 95;
  const int w = image.width(), h = image.height(), c = image.channels();
  if (image.data().size() > INT_MAX / 4) failImageWrite(path, "too large for its format");
  const bool shortSizes = ending == ".jpg" || ending == ".jpeg" || ending == ".tga";
  if (shortSizes && (w > 65535 || h > 65535))
    failImageWrite(path, "its format holds 65535 x 65535 pixels at most");

  std::string out;
  int done = 0;
  if (ending == ".hdr") {
    done = stbi_write_hdr_to_func(append, &out, w, h, c, toRgbe(image).data());
  } else {
    const std::vector<unsigned char> bytes = toBytes(image);
    if (ending == ".png") {
      done = stbi_write_png_to_func(append, &out, w, h, c, bytes.data(), w * c);
    } else if (ending == ".tga") {
      done = stbi_write_tga_to_func(append, &out, w, h, c, bytes.data());
    } else if (ending == ".bmp") {
      done = stbi_write_bmp_to_func(append, &out, w, h, c, bytes.data());
    } else {
      done = stbi_write_jpg_to_func(append, &out, w, h, c, bytes.data(), kJpgQuality);
    }
  }
  if (!done) failImageWrite(path, "it could not be encoded");
  AtomicFile file(path);
  file.write(out.data(), out.size());
  file.commit();
}

}  // namespace lampyris
