// SPDX-License-Identifier: Apache-2.0
/// Images in memory, and files of them.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <typeindex>
#include <utility>
#include <vector>

#include "core/rgb.h"
#include "core/vector.h"

namespace lampyris {

/// Floats, row by row from the top, channels interleaved. Values are linear unless said otherwise.
class Image {
 public:
  Image() = default;
  Image(int width, int height, int channels)
      : width_(width),
        height_(height),
        channels_(channels),
        data_(static_cast<size_t>(width) * static_cast<size_t>(height) *
              static_cast<size_t>(channels)) {}

  int width() const { return width_; }
  int height() const { return height_; }
  int channels() const { return channels_; }
  bool empty() const { return data_.empty(); }
  float& at(int x, int y, int c) { return data_[index(x, y, c)]; }
  float at(int x, int y, int c) const { return data_[index(x, y, c)]; }
  /// The first three channels; a grey image gives its one channel three times.
  Rgb rgb(int x, int y) const;
  void setRgb(int x, int y, const Rgb& c);
  std::vector<float>& data() { return data_; }
  const std::vector<float>& data() const { return data_; }

 private:
  size_t index(int x, int y, int c) const {
    return (static_cast<size_t>(y) * static_cast<size_t>(width_) + static_cast<size_t>(x)) *
               static_cast<size_t>(channels_) +
           static_cast<size_t>(c);
  }
  int width_ = 0, height_ = 0, channels_ = 0;
  std::vector<float> data_;
};

/// Extra channels of an EXR file: name ("albedo.R") and one float a pixel.
struct ImageLayer {
  std::string name;
  std::vector<float> values;
};

/// An image file's pixels, and whether its values are sRGB-encoded (8-bit formats) or linear. 8-
/// and 16-bit values are scaled to [0, 1] and not yet decoded.
struct LoadedImage {
  Image image;
  bool srgbEncoded = false;
};

/// Reads PNG, JPG, TGA, BMP, HDR, EXR or PFM by the file's ending. Throws IoError.
LoadedImage readImageFile(const std::string& path);
/// The same with all values made linear (as image comparison wants them).
Image readLinearImage(const std::string& path);

/// Where a written image lies within a larger one (EXR data and display windows).
struct ImagePlacement {
  Int2 offset{0}, fullSize{0};
};
/// Writes by the path's ending: .exr (32-bit floats, or half floats as pbrt-v3 if not `fullFloat`;
/// layers, always 32-bit, and metadata), .pfm, .hdr, and .png, .tga, .bmp, .jpg (8 bit,
/// sRGB-encoded, clamped). Goes to a temporary file beside it first. Throws IoError.
struct WriteOptions {
  std::vector<std::pair<std::string, std::string>> metadata{};
  std::vector<ImageLayer> layers{};
  ImagePlacement placement{};
  bool fullFloat = true;
};
void writeImageFile(const std::string& path, const Image& image, const WriteOptions& options = {});
/// True if the ending is one that writeImageFile knows.
bool isWritableImagePath(const std::string& path);

float srgbToLinear(float v);
float linearToSrgb(float v);
/// Makes sRGB-encoded values linear, all channels but alpha (the second of two, the fourth of
/// four).
void decodeSrgb(Image& image);

/// What is made of image files (texture pyramids) is made once, when first asked for. Thread-safe.
class ImageCache {
 public:
  /// What `make` returned when first called for this type and key. Others who ask for the same
  /// wait; where `make` throws, nothing is kept. `make` must not ask for the same type and key.
  template <class T>
  std::shared_ptr<const T> shared(const std::string& key,
                                  const std::function<std::shared_ptr<const T>()>& make) {
    return std::static_pointer_cast<const T>(
        fill({std::type_index(typeid(T)), key}, [&make] { return make(); }));
  }

 private:
  using Key = std::pair<std::type_index, std::string>;
  struct Slot {
    std::mutex mutex;
    std::shared_ptr<const void> value;
  };
  std::shared_ptr<const void> fill(const Key& key,
                                   const std::function<std::shared_ptr<const void>()>& make);

  std::mutex mutex_;
  std::map<Key, std::shared_ptr<Slot>> slots_;
};

}  // namespace lampyris
