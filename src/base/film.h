// SPDX-License-Identifier: Apache-2.0
/// The image that is being rendered.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "base/aov.h"
#include "base/filter.h"
#include "base/texture.h"
#include "core/bounds.h"
#include "core/registry.h"
#include "core/rgb.h"

namespace lampyris {

/// Name, value pairs written into image files that can hold them.
using ImageMetadata = std::vector<std::pair<std::string, std::string>>;

class Film {
 public:
  virtual ~Film() = default;
  virtual Int2 resolution() const = 0;     ///< of the whole image
  virtual PixelBounds bounds() const = 0;  ///< the pixels that are rendered (crop window)
  virtual const Filter& filter() const = 0;
  virtual const std::string& filename() const = 0;

  /// Adds a sample with the weight of its filter sample. A pixel's samples come from one thread, in
  /// the order of their indices. Returns false, and adds black, if the radiance is not finite or
  /// negative.
  virtual bool addSample(const Int2& pixel, const Rgb& radiance, float weight) = 0;
  /// The AOVs that the film keeps beside the image.
  virtual AovSet aovs() const { return {}; }
  /// Adds what the sample just added tells for them.
  virtual void addAovs(const Int2& pixel, const AovRecord& record) { (void)pixel, (void)record; }

  /// Opens the light image: a part of every pixel made by paths that choose their place on the film
  /// themselves. Its sums are in 64-bit fixed point, so that no order of additions changes a bit:
  /// steps of 2⁻²⁶ × `typical`, which is about the mean value of a splat (> 0, finite) and the same
  /// whenever the image is rendered. Goes on with what restore() has brought.
  virtual void openLightImage(double typical) = 0;
  /// Adds `value` about a place on the film (in pixels, may lie beyond the image), spread by the
  /// filter. From any thread. False, and nothing is added, if it is not finite or negative.
  static constexpr double kLightImagePixelBytes = 24;  ///< that it takes of memory
  virtual bool addSplat(const Vec2& film, const Rgb& value) = 0;
  /// Counts paths whose splats are in the light image: a pixel's sum of splats is divided by their
  /// number in relation to the number of pixels in bounds(), so that a splat's value is what a
  /// sample of the pixel would have.
  virtual void addLightPaths(uint64_t count) = 0;

  virtual uint64_t sampleCount(const Int2& pixel) const = 0;
  /// Mean so far, scaled, negative values clipped.
  virtual Rgb pixel(const Int2& pixel) const = 0;
  /// Estimated relative error of the image: the standard error of the pixels' means, as root mean
  /// square over the image, in relation to the image's mean.
  virtual double noise() const = 0;

  /// Writes the image to `path` (EXR, PNG, PFM … by its ending): to a temporary file beside it that
  /// then takes its name, so that a full disk never destroys an older image. Throws IoError.
  virtual void write(const std::string& path, const ImageMetadata& metadata) const = 0;
  /// The sums of all pixels as bytes, and back. restore() returns false if they are not of a film
  /// with the same bounds.
  virtual std::string save() const = 0;
  virtual bool restore(const std::string& bytes) = 0;
};

struct FilmContext : BuildContext {
  std::unique_ptr<Filter>& filter;  ///< taken over
};

using FilmRegistry = Registry<Film, FilmContext>;

}  // namespace lampyris
