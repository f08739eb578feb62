// SPDX-License-Identifier: Apache-2.0
// The film "image". Parameters, crop windows and clamping follow pbrt-v3; its filter is sampled
// (base/filter.h), so a sample touches one pixel and no locks are needed.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <atomic>
#include <cmath>
#include <limits>
#include <new>

#include "base/film.h"
#include "core/image.h"
#include "core/math.h"
#include "core/memory.h"
#include "film/aov_sums.h"
#include "film/light_image.h"
#include "film/pixel_sums.h"

namespace lampyris {

namespace {

struct ImageFilmParameters {
  int xResolution = 1280, yResolution = 720;
  std::vector<float> cropWindow{0, 1, 0, 1};
  float scale = 1, maxSampleLuminance = kInfinity, diagonal = 35;
  std::string filename = "lampyris.exr";
  std::vector<std::string> aovs;
  void declare(Declaration& d) {
    d.add("xresolution", xResolution, "Width of the image, in pixels.").range(1, 1 << 20);
    d.add("yresolution", yResolution, "Height of the image, in pixels.").range(1, 1 << 20);
    d.add("cropwindow", cropWindow,
          "The part of the image to render: x0 x1 y0 y1 as fractions of its width and height.")
        .defaultIs("[0 1 0 1]");
    d.add("scale", scale, "Factor on the pixels.").range(0, 1e30);
    d.add("maxsampleluminance", maxSampleLuminance,
          "A sample brighter than this is darkened to it.")
        .atLeast(0)
        .defaultIs("infinity");
    d.add("diagonal", diagonal, "Diagonal of the film, in millimetres.").range(1e-6, 1e6);
    d.add("filename", filename, "Where the image is written, in the format of its ending.");
    d.add("aovs", aovs,
          fmt::format("Layers to write beside the image into EXR files: {}.",
                      fmt::join(kAovNames, ", ")));
  }
};

/// Plain loads and stores that another thread may race with: a preview reads sums while samples
/// are added. Each value is whole; sums and count may differ by one sample.
template <class T>
T load(const T& v) {
  return std::atomic_ref<T>(const_cast<T&>(v)).load(std::memory_order_relaxed);
}
template <class T>
void store(T& v, T to) {
  std::atomic_ref<T>(v).store(to, std::memory_order_relaxed);
}

float toFloat(double v) {
  constexpr double kMax = std::numeric_limits<float>::max();
  return static_cast<float>(std::clamp(v, 0., kMax));
}

/// Colours outside the sRGB gamut have negative components, but light has no negative luminance
/// beyond what rounding leaves of the largest component.
bool isValid(const Rgb& c) {
  const float largest = std::max(std::abs(c.r), std::max(std::abs(c.g), std::abs(c.b)));
  return c.isFinite() && c.luminance() >= -1e-5f * largest;
}

class ImageFilm final : public Film {
 public:
  ImageFilm(const ImageFilmParameters& p, const PixelBounds& bounds, AovSet aovs,
            std::unique_ptr<Filter> filter)
      : resolution_(p.xResolution, p.yResolution),
        bounds_(bounds),
        filter_(std::move(filter)),
        filename_(p.filename),
        scale_(static_cast<double>(p.scale)),
        maxLuminance_(p.maxSampleLuminance),
        pixels_(static_cast<size_t>(bounds.area())),
        aovs_(aovs, pixels_.size()),
        lightImage_(bounds, *filter_) {}

  Int2 resolution() const override { return resolution_; }
  PixelBounds bounds() const override { return bounds_; }
  const Filter& filter() const override { return *filter_; }
  const std::string& filename() const override { return filename_; }

  bool addSample(const Int2& pixel, const Rgb& radiance, float weight) override {
    const size_t i = index(pixel);
    PixelSums& sums = pixels_[i];
    store(sums.count, sums.count + 1);
    if (!isValid(radiance)) return false;
    const auto y = static_cast<double>(radiance.luminance());
    const double factor = static_cast<double>(weight) * darkening(y);
    const std::array<double, 3> rgb{factor * static_cast<double>(radiance.r),
                                    factor * static_cast<double>(radiance.g),
                                    factor * static_cast<double>(radiance.b)};
    store(sums.r, sums.r + rgb[0]);
    store(sums.g, sums.g + rgb[1]);
    store(sums.b, sums.b + rgb[2]);
    store(sums.luminanceSquares, sums.luminanceSquares + sqr(factor * y));
    aovs_.addColour(i, rgb);
    return true;
  }

  AovSet aovs() const override { return aovs_.set(); }
  void addAovs(const Int2& pixel, const AovRecord& record) override {
    aovs_.add(index(pixel), record);
  }

  void openLightImage(double typical) override { lightImage_.open(typical); }
  bool addSplat(const Vec2& film, const Rgb& value) override {
    if (!isValid(value)) return false;
    const double factor = darkening(static_cast<double>(value.luminance()));
    lightImage_.add(film, value * static_cast<float>(factor));
    return true;
  }
  void addLightPaths(uint64_t count) override { lightImage_.addPaths(count); }

  uint64_t sampleCount(const Int2& pixel) const override {
    return load(pixels_[index(pixel)].count);
  }

  Rgb pixel(const Int2& pixel) const override {
    const size_t i = index(pixel);
    const PixelSums& sums = pixels_[i];
    const uint64_t count = load(sums.count);
    const double factor = count > 0 ? 1 / static_cast<double>(count) : 0;
    const auto light = lightImage_.mean(i);
    return {toFloat((load(sums.r) * factor + light[0]) * scale_),
            toFloat((load(sums.g) * factor + light[1]) * scale_),
            toFloat((load(sums.b) * factor + light[2]) * scale_)};
  }

  double noise() const override;

  void write(const std::string& path, const ImageMetadata& metadata) const override {
    const Int2 size = bounds_.size();
    Image image(size.x, size.y, 3);
    for (int y = 0; y < size.y; ++y)
      for (int x = 0; x < size.x; ++x) image.setRgb(x, y, pixel(bounds_.min + Int2(x, y)));
    WriteOptions options;
    options.metadata = metadata;
    options.placement = {bounds_.min, resolution_};
    options.layers = aovs_.layers(pixels_, scale_);
    writeImageFile(path, image, options);
  }

  std::string save() const override {
    std::string bytes = encodeSums({bounds_, aovs_.set()}, pixels_, aovs_.values());
    if (lightImage_.isOpen()) bytes += lightImage_.encode();
    return bytes;
  }
  bool restore(const std::string& bytes) override;

 private:
  /// The factor for a sample of luminance `y`.
  double darkening(double y) const {
    return y > static_cast<double>(maxLuminance_) ? static_cast<double>(maxLuminance_) / y : 1;
  }
  size_t index(const Int2& p) const {
    assert(bounds_.contains(p));
    const Int2 local = p - bounds_.min;
    return static_cast<size_t>(local.y) * static_cast<size_t>(bounds_.size().x) +
           static_cast<size_t>(local.x);
  }

  Int2 resolution_;
  PixelBounds bounds_;
  std::unique_ptr<Filter> filter_;
  std::string filename_;
  double scale_;
  float maxLuminance_;
  std::vector<PixelSums> pixels_;
  AovSums aovs_;
  LightImage lightImage_;
};

bool ImageFilm::restore(const std::string& bytes) {
  const SumsKey key{bounds_, aovs_.set()};
  if (decodeSums(bytes, key, pixels_, aovs_.values())) return true;
  const size_t tail = lightImage_.encodedSize();
  if (bytes.size() < tail) return false;
  const std::string_view all = bytes, light = all.substr(bytes.size() - tail);
  return LightImage::isIntact(light) &&
         decodeSums(all.substr(0, bytes.size() - tail), key, pixels_, aovs_.values()) &&
         lightImage_.decode(light);
}

/// Of the samples alone: splats, which come from anywhere, keep no squares, but count for the mean.
/// Infinite as long as no pixel has two samples: nothing is known then, and nobody should stop.
double ImageFilm::noise() const {
  double meanSum = 0, errorSum = 0;
  uint64_t pixels = 0;
  for (size_t i = 0; i < pixels_.size(); ++i) {
    const PixelSums& sums = pixels_[i];
    const uint64_t count = load(sums.count);
    if (count < 2) continue;
    const auto n = static_cast<double>(count);
    const double mean =
        (0.212671 * load(sums.r) + 0.715160 * load(sums.g) + 0.072169 * load(sums.b)) / n;
    errorSum += std::max(0., load(sums.luminanceSquares) / n - mean * mean) / (n - 1);
    const auto light = lightImage_.mean(i);
    meanSum += mean + 0.212671 * light[0] + 0.715160 * light[1] + 0.072169 * light[2];
    ++pixels;
  }
  if (pixels == 0) return std::numeric_limits<double>::infinity();
  const auto n = static_cast<double>(pixels);
  const double error = std::sqrt(errorSum / n), mean = std::abs(meanSum / n);
  if (error == 0) return 0;
  return mean > 0 ? error / mean : std::numeric_limits<double>::infinity();
}

/// pbrt-v3's rule, in its precision: ⌈resolution · fraction⌉ on both ends.
PixelBounds cropBounds(const ImageFilmParameters& p, SourceLocation where) {
  const auto& crop = p.cropWindow;
  if (crop.size() != 4)
    throw SceneError(where,
                     fmt::format("parameter \"cropwindow\": expected 4 values (x0 x1 y0 y1), "
                                 "got {}",
                                 crop.size()));
  const auto border = [](int resolution, float fraction) {
    return static_cast<int>(
        std::ceil(static_cast<float>(resolution) * std::clamp(fraction, 0.f, 1.f)));
  };
  if (!(crop[0] < crop[1] && crop[2] < crop[3]))
    throw SceneError(where, fmt::format("parameter \"cropwindow\": expected x0 < x1 and y0 < y1, "
                                        "got {} {} {} {}",
                                        crop[0], crop[1], crop[2], crop[3]));
  const PixelBounds bounds{{border(p.xResolution, crop[0]), border(p.yResolution, crop[2])},
                           {border(p.xResolution, crop[1]), border(p.yResolution, crop[3])}};
  if (bounds.area() == 0)
    throw SceneError(where,
                     fmt::format("parameter \"cropwindow\": {} {} {} {} holds no pixel of "
                                 "{} x {}",
                                 crop[0], crop[1], crop[2], crop[3], p.xResolution, p.yResolution));
  return bounds;
}

/// `lists`: names, alone or several in a string with commas or blanks between.
AovSet aovSet(const std::vector<std::string>& lists, SourceLocation where) {
  const std::vector<std::string> known(kAovNames.begin(), kAovNames.end());
  AovSet set;
  for (const std::string& list : lists)
    for (size_t at = 0; (at = list.find_first_not_of(", ", at)) != std::string::npos;) {
      const size_t end = std::min(list.find_first_of(", ", at), list.size());
      const std::string name = list.substr(at, end - at);
      const auto found = std::find(known.begin(), known.end(), name);
      if (found == known.end())
        throw SceneError(
            where, fmt::format("parameter \"aovs\": unknown layer \"{}\"{}; there are: {}", name,
                               didYouMean(name, known), fmt::join(known, ", ")));
      set.add(static_cast<Aov>(found - known.begin()));
      at = end;
    }
  return set;
}

/// A mistyped resolution should be an error at once, not a machine that swaps to death.
void checkMemory(const PixelBounds& bounds, AovSet aovs, SourceLocation where) {
  const size_t pixelBytes = sizeof(PixelSums) + AovSums::sumsPerPixel(aovs) * sizeof(double);
  const double bytes = static_cast<double>(bounds.area()) * static_cast<double>(pixelBytes);
  if (bytes > availableMemory())
    throw SceneError(where, fmt::format("{} x {} pixels need {:.0f} GB of memory, more than there "
                                        "is; render a smaller image or crop window",
                                        bounds.size().x, bounds.size().y, bytes * 1e-9));
}

std::unique_ptr<Film> create(const ImageFilmParameters& p, const ParameterSet& set,
                             const FilmContext& context) {
  const auto at = [&](const char* name) {
    const Parameter* parameter = set.find(name);
    return parameter && parameter->location.known() ? parameter->location : context.location;
  };
  const PixelBounds bounds = cropBounds(p, at("cropwindow"));
  // Here and not when the image is done, which may be hours later.
  if (!isWritableImagePath(p.filename))
    throw SceneError(
        at("filename"),
        fmt::format("parameter \"filename\": cannot write \"{}\"; expected a name that "
                    "ends in .exr, .pfm, .png, .hdr, .tga, .bmp or .jpg",
                    p.filename));
  if (!context.filter) throw SceneError(context.location, "a film needs a pixel filter");
  const AovSet aovs = aovSet(p.aovs, at("aovs"));
  checkMemory(bounds, aovs, at("xresolution"));
  try {
    return std::make_unique<ImageFilm>(p, bounds, aovs, std::move(context.filter));
  } catch (const std::bad_alloc&) {
    throw SceneError(at("xresolution"), "not enough memory for the image; make it smaller");
  }
}

}  // namespace

FilmRegistry::Entry imageFilmPlugin() {
  const Schema schema = Schema::of<ImageFilmParameters>();
  return {{"image", "Renders into an image file.", schema, {}},
          [schema](const ParameterSet& set, const FilmContext& context) {
            ImageFilmParameters p;
            schema.read(set, &p);
            return create(p, set, context);
          }};
}

}  // namespace lampyris
