// SPDX-License-Identifier: Apache-2.0
// The film "image". Parameters, crop windows and clamping follow pbrt-v3; its filter is sampled
// (base/filter.h), so a sample touches one pixel and no locks are needed.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <limits>
#include <new>

#include "base/film.h"
#include "core/image.h"
#include "core/math.h"
#include "core/memory.h"
#include "core/rejections.h"
#include "film/film_sums.h"

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
        .defaultIs("[0 1 0 1]")
        .rangeIs("x0 < x1 and y0 < y1, clamped to 0 and 1, with pixels between");
    d.add("scale", scale, "Factor on the pixels.").range(0, 1e30);
    d.add("maxsampleluminance", maxSampleLuminance,
          "A sample brighter than this is darkened to it.")
        .atLeast(0)
        .defaultIs("infinity");
    d.add("diagonal", diagonal, "Diagonal of the film, in millimetres.").range(1e-6, 1e6);
    d.add("filename", filename, "Where the image is written, in the format of its ending.")
        .rangeIs("any file name that ends in .exr, .pfm, .png, .hdr, .tga, .bmp or .jpg");
    d.add("aovs", aovs,
          fmt::format("Layers to write beside the image into EXR files: {}.",
                      fmt::join(kAovNames, ", ")))
        .rangeIs("any of these names");
  }
};

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
        filter_(std::move(filter)),
        filename_(p.filename),
        maxLuminance_(p.maxSampleLuminance),
        sums_({resolution_, bounds, aovs, static_cast<double>(p.scale)}, filter_.get()) {}

  Int2 resolution() const override { return resolution_; }
  PixelBounds bounds() const override { return sums_.frame().bounds; }
  const Filter& filter() const override { return *filter_; }
  const std::string& filename() const override { return filename_; }

  bool addSample(const Int2& pixel, const Rgb& radiance, float weight) override {
    const size_t i = sums_.index(pixel);
    if (!isValid(radiance)) {
      sums_.addBlack(i);
      return false;
    }
    const auto y = static_cast<double>(radiance.luminance());
    const double factor = static_cast<double>(weight) * darkening(y);
    sums_.addSample(
        i,
        {factor * static_cast<double>(radiance.r), factor * static_cast<double>(radiance.g),
         factor * static_cast<double>(radiance.b)},
        factor * y);
    return true;
  }

  AovSet aovs() const override { return sums_.frame().aovs; }
  void addAovs(const Int2& pixel, const AovRecord& record) override {
    sums_.aovs().add(sums_.index(pixel), record);
  }

  void openLightImage(double typical) override { sums_.lightImage().open(typical); }
  bool addSplat(const Vec2& film, const Rgb& value) override {
    if (!isValid(value)) {
      countRejection(Rejection::Splat);
      return false;
    }
    const double factor = darkening(static_cast<double>(value.luminance()));
    sums_.lightImage().add(film, value * static_cast<float>(factor));
    return true;
  }
  void addLightPaths(uint64_t count) override { sums_.lightImage().addPaths(count); }

  uint64_t sampleCount(const Int2& pixel) const override {
    return sums_.sampleCount(sums_.index(pixel));
  }
  Rgb pixel(const Int2& pixel) const override { return sums_.pixel(sums_.index(pixel)); }
  double noise() const override { return sums_.noise(); }
  void write(const std::string& path, const ImageMetadata& metadata) const override {
    sums_.write(path, metadata);
  }
  std::string save() const override { return sums_.save(); }
  bool restore(const std::string& bytes) override { return sums_.restore(bytes); }

 private:
  /// The factor for a sample of luminance `y`.
  double darkening(double y) const {
    if (!(y > static_cast<double>(maxLuminance_))) return 1;
    countRejection(Rejection::DarkenedSample);
    return static_cast<double>(maxLuminance_) / y;
  }

  Int2 resolution_;
  std::unique_ptr<Filter> filter_;
  std::string filename_;
  float maxLuminance_;
  FilmSums sums_;
};

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
  // A mistyped resolution should be an error at once, not a machine that swaps to death.
  expectMemory(FilmSums::memory({{}, bounds, aovs}),
               fmt::format("an image of {} x {} pixels", bounds.size().x, bounds.size().y),
               at("xresolution"));
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
