// SPDX-License-Identifier: Apache-2.0
/// One pixel instead of an image: to look at its samples.
#pragma once

#include <string>
#include <vector>

#include "base/film.h"

namespace lampyris {

/// A film of which only one pixel is rendered, and which keeps its samples.
class PixelProbe final : public Film {
 public:
  /// `pixel` must lie in film.bounds().
  PixelProbe(Film& film, const Int2& pixel) : film_(film), pixel_(pixel) {}

  Int2 resolution() const override { return film_.resolution(); }
  PixelBounds bounds() const override { return {pixel_, pixel_ + 1}; }
  const Filter& filter() const override { return film_.filter(); }
  const std::string& filename() const override { return film_.filename(); }
  bool addSample(const Int2& pixel, const Rgb& radiance, float weight) override;
  /// Splats come from the paths of all pixels: those of one pixel alone tell nothing of it.
  void openLightImage(double) override {}
  bool addSplat(const Vec2&, const Rgb&) override { return true; }
  void addLightPaths(uint64_t) override {}
  uint64_t sampleCount(const Int2& pixel) const override { return film_.sampleCount(pixel); }
  Rgb pixel(const Int2& pixel) const override { return film_.pixel(pixel); }
  double noise() const override { return film_.noise(); }
  void write(const std::string& path, const ImageMetadata& metadata) const override {
    film_.write(path, metadata);
  }
  std::string save() const override { return film_.save(); }
  bool restore(const std::string& bytes) override { return film_.restore(bytes); }

  /// The pixel's value, the spread of its samples, and with `verbose` each of them.
  std::string report(bool verbose) const;

 private:
  struct Sample {
    Rgb radiance;
    float weight;
  };
  Film& film_;
  const Int2 pixel_;
  std::vector<Sample> samples_;
};

}  // namespace lampyris
