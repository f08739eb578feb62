// SPDX-License-Identifier: Apache-2.0
/// Images as lights emit them: maps of environments and point lights, pictures on surfaces.
#pragma once

#include <memory>
#include <string>

#include "base/texture.h"
#include "core/image.h"
#include "core/rgb.h"
#include "core/vector.h"

namespace lampyris {

/// All values are finite and ≥ 0.
class EmissionImage {
 public:
  /// What 8-bit values mean: what they are (pbrt-v3's lights), or sRGB-encoded light.
  enum class Encoding : uint8_t { Linear, Srgb };

  /// The file `name` of the scene, read once per cache and encoding. Values that no light can have
  /// count as 0, with a warning. Throws IoError.
  static std::shared_ptr<const EmissionImage> load(const std::string& name, Encoding encoding,
                                                   ImageCache& images, const BuildContext& context);
  explicit EmissionImage(Image image);

  int width() const { return image_.width(); }
  int height() const { return image_.height(); }
  Rgb texel(int x, int y) const { return image_.rgb(x, y); }
  /// Bilinear between the texels' centres; (0, 0) is the upper left corner, (1, 1) the lower right
  /// one, and the image repeats beyond. Takes any numbers, not finite ones too.
  Rgb bilinear(const Vec2& st) const;
  /// Of all texels alike.
  Rgb mean() const { return mean_; }
  /// Mean of the texels, each with weight(s, t) of its centre; black if all weights are 0.
  template <class Weight>
  Rgb weightedMean(const Weight& weight) const;

 private:
  Image image_;
  Rgb mean_;
};

template <class Weight>
Rgb EmissionImage::weightedMean(const Weight& weight) const {
  double r = 0, g = 0, b = 0, sum = 0;
  for (int y = 0; y < height(); ++y) {
    const double t = (y + 0.5) / height();
    for (int x = 0; x < width(); ++x) {
      const double w = weight((x + 0.5) / width(), t);
      const Rgb c = texel(x, y);
      r += w * static_cast<double>(c.r);
      g += w * static_cast<double>(c.g);
      b += w * static_cast<double>(c.b);
      sum += w;
    }
  }
  if (!(sum > 0)) return Rgb();
  return {static_cast<float>(r / sum), static_cast<float>(g / sum), static_cast<float>(b / sum)};
}

}  // namespace lampyris
