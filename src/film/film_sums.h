// SPDX-License-Identifier: Apache-2.0
/// What a film holds of its image; how samples become sums is the film's own matter.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "base/film.h"
#include "film/aov_sums.h"
#include "film/light_image.h"
#include "film/pixel_sums.h"

namespace lampyris {

/// Sums of samples, AOVs and splats. All of them are the same in any order (core/wide_sum.h,
/// film/light_image.h), so the image of a sample range is that of its parts, to the last bit.
class FilmSums {
 public:
  /// `filter` as for LightImage.
  explicit FilmSums(const FilmFrame& frame, const Filter* filter = nullptr);

  const FilmFrame& frame() const { return frame_; }
  size_t index(const Int2& pixel) const;
  /// In bytes, of a film with this frame, without a light image.
  static double memory(const FilmFrame& frame);

  /// Adds a sample's colour times its weight, and its luminance likewise, to a pixel. Values are
  /// stored whole, for a preview may read them meanwhile.
  void addSample(size_t pixel, const std::array<double, 3>& rgb, double luminance);
  /// Adds a sample that is black.
  void addBlack(size_t pixel);
  AovSums& aovs() { return aovs_; }
  LightImage& lightImage() { return lightImage_; }

  /// See Film.
  uint64_t sampleCount(size_t pixel) const;
  Rgb pixel(size_t pixel) const;
  double noise() const;
  void write(const std::string& path, const ImageMetadata& metadata) const;

  std::string save() const;
  bool restore(std::string_view bytes);
  /// Sums that save() has written of any film; null if the bytes are damaged. They take no splats.
  static std::unique_ptr<FilmSums> decode(std::string_view bytes);
  /// Adds another's sums; false, and nothing happens, if the frames or the units of the light
  /// images differ.
  bool merge(const FilmSums& other);

 private:
  FilmFrame frame_;
  std::vector<PixelSums> pixels_;
  AovSums aovs_;
  LightImage lightImage_;
};

}  // namespace lampyris
