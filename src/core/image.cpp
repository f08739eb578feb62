// SPDX-License-Identifier: Apache-2.0
#include "core/image.h"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <filesystem>
#include <new>

#include "core/error.h"
#include "core/image_formats.h"
#include "core/parallel.h"
#include "core/source.h"

namespace lampyris {

namespace {

constexpr std::string_view kEndings = ".exr, .pfm, .hdr, .png, .tga, .bmp, .jpg or .jpeg";

/// The path's ending in lower case, with its dot.
std::string endingOf(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  for (char& c : ending)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return ending;
}

bool isStbEnding(const std::string& e) {
  return e == ".png" || e == ".jpg" || e == ".jpeg" || e == ".tga" || e == ".bmp" || e == ".hdr";
}

/// srgbToLinear, from a table for the values that 8 bits can hold.
float decodeValue(float v) {
  static const std::array<float, 256> table = [] {
    std::array<float, 256> t{};
    for (size_t i = 0; i < t.size(); ++i) t[i] = srgbToLinear(static_cast<float>(i) / 255.f);
    return t;
  }();
  if (!(v >= 0 && v <= 1)) return srgbToLinear(v);
  const auto i = static_cast<size_t>(std::lround(v * 255.f));
  return v == static_cast<float>(i) / 255.f ? table[i] : srgbToLinear(v);
}

}  // namespace

Rgb Image::rgb(int x, int y) const {
  const float* const p = &data_[index(x, y, 0)];
  return channels_ >= 3 ? Rgb(p[0], p[1], p[2]) : Rgb(p[0]);
}

void Image::setRgb(int x, int y, const Rgb& c) {
  float* const p = &data_[index(x, y, 0)];
  if (channels_ < 3) {
    p[0] = c.luminance();
    return;
  }
  p[0] = c.r;
  p[1] = c.g;
  p[2] = c.b;
}

float srgbToLinear(float v) {
  return v <= 0.04045f ? v / 12.92f : std::pow((v + 0.055f) / 1.055f, 2.4f);
}

float linearToSrgb(float v) {
  return v <= 0.0031308f ? 12.92f * v : 1.055f * std::pow(v, 1 / 2.4f) - 0.055f;
}

void decodeSrgb(Image& image) {
  const auto channels = static_cast<size_t>(image.channels());
  const size_t colours = channels >= 3 ? 3 : 1;
  std::vector<float>& data = image.data();
  const size_t pixels = channels > 0 ? data.size() / channels : 0;
  parallelFor(pixels, 1 << 14, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i)
      for (size_t c = 0; c < colours; ++c)
        data[i * channels + c] = decodeValue(data[i * channels + c]);
  });
}

void failImageRead(const std::string& path, const std::string& why) {
  throw IoError(fmt::format("cannot read image \"{}\": {}", path, why));
}

void failImageWrite(const std::string& path, const std::string& why) {
  throw IoError(fmt::format("cannot write image \"{}\": {}", path, why));
}

void checkImageSize(const std::string& path, int64_t width, int64_t height) {
  if (width < 1 || height < 1)
    failImageRead(path, fmt::format("a size of {} x {} pixels", width, height));
  if (width > kMaxImagePixels || height > kMaxImagePixels || width * height > kMaxImagePixels)
    failImageRead(path, fmt::format("{} x {} pixels are more than the supported {}", width, height,
                                    kMaxImagePixels));
}

LoadedImage readImageFile(const std::string& path) {
  const std::string ending = endingOf(path);
  const bool stb = isStbEnding(ending);
  if (!stb && ending != ".exr" && ending != ".pfm")
    failImageRead(path, fmt::format("unknown ending \"{}\", expected {}", ending, kEndings));
  try {
    const MappedFile file(path);
    if (file.text().empty()) failImageRead(path, "the file is empty");
    if (stb) return (isJpeg(file.text()) ? readJpegImage : readStbImage)(path, file.text());
    return ending == ".exr" ? readExrImage(path, file.text()) : readPfmImage(path, file.text());
  } catch (const std::bad_alloc&) {
    failImageRead(path, "not enough memory");
  }
}

Image readLinearImage(const std::string& path) {
  LoadedImage loaded = readImageFile(path);
  if (loaded.srgbEncoded) decodeSrgb(loaded.image);
  return std::move(loaded.image);
}

bool isWritableImagePath(const std::string& path) {
  const std::string ending = endingOf(path);
  return isStbEnding(ending) || ending == ".exr" || ending == ".pfm";
}

void writeImageFile(const std::string& path, const Image& image, const WriteOptions& options) {
  const std::string ending = endingOf(path);
  if (!isWritableImagePath(path))
    failImageWrite(path, fmt::format("unknown ending \"{}\", expected {}", ending, kEndings));
  if (image.empty()) failImageWrite(path, "the image has no pixels");
  if (image.channels() > 4)
    failImageWrite(path,
                   fmt::format("{} channels; extra ones belong into layers", image.channels()));
  if (ending == ".exr") {
    writeExrImage(path, image, options);
  } else if (ending == ".pfm") {
    writePfmImage(path, image);
  } else {
    writeStbImage(path, ending, image);
  }
}

std::shared_ptr<const void> ImageCache::fill(
    const Key& key, const std::function<std::shared_ptr<const void>()>& make) {
  std::shared_ptr<Slot> slot;
  {
    const std::lock_guard lock(mutex_);
    std::shared_ptr<Slot>& entry = slots_[key];
    if (!entry) entry = std::make_shared<Slot>();
    slot = entry;
  }
  // Files are read outside of the cache's lock, so that different ones are read at once.
  const std::lock_guard lock(slot->mutex);
  if (!slot->value) slot->value = make();
  return slot->value;
}

}  // namespace lampyris
