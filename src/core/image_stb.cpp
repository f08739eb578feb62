// SPDX-License-Identifier: Apache-2.0
// PNG, TGA, BMP and HDR files through stb, and JPG files to write.
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

constexpr size_t kMemoryOfHeaders = 1 << 16;

/// More than stb needs for an image of this size. Its rows may begin with a byte of their own.
size_t memoryFor(int width, int height, std::string_view bytes) {
  constexpr size_t kPixel = 32, kRow = 4;
  const size_t row = kPixel * static_cast<size_t>(width) + kRow;
  return kMemoryOfHeaders + 4 * bytes.size() + row * static_cast<size_t>(height);
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
  StbMemory stbMemory(kMemoryOfHeaders);
  const auto* const memory = reinterpret_cast<const stbi_uc*>(bytes.data());
  const int size = static_cast<int>(bytes.size());
  int width = 0, height = 0, channels = 0;
  if (!stbi_info_from_memory(memory, size, &width, &height, &channels))
    failImageRead(path, "this is no PNG, JPG, TGA, BMP or HDR image, or it is damaged");
  checkImageSize(path, width, height);
  const int64_t maxPixelsPerByte = isPng(bytes) ? kMaxPixelsPerByte : kMaxOtherPixelsPerByte;
  if (int64_t{width} * height > maxPixelsPerByte * size)
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
