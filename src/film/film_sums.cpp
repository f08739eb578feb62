// SPDX-License-Identifier: Apache-2.0
#include "film/film_sums.h"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cmath>
#include <limits>

#include "core/image.h"
#include "core/math.h"

namespace lampyris {

namespace {

/// Plain loads and stores that another thread may race with. Each value is whole; sums and count
/// may differ by one sample.
template <class T>
T load(const T& v) {
  return std::atomic_ref<T>(const_cast<T&>(v)).load(std::memory_order_relaxed);
}
template <class T>
void store(T& v, T to) {
  std::atomic_ref<T>(v).store(to, std::memory_order_relaxed);
}

void add(WideSum& to, double term) {
  WideSum sum = to;
  sum.add(term);
  store(to.high, sum.high);
  store(to.low, sum.low);
}

float toFloat(double v) {
  constexpr double kMax = std::numeric_limits<float>::max();
  return static_cast<float>(std::clamp(v, 0., kMax));
}

bool equal(const FilmFrame& a, const FilmFrame& b) {
  return a.resolution == b.resolution && a.bounds == b.bounds && a.aovs.bits() == b.aovs.bits() &&
         a.scale == b.scale;
}

}  // namespace

FilmSums::FilmSums(const FilmFrame& frame, const Filter* filter)
    : frame_(frame),
      pixels_(static_cast<size_t>(frame.bounds.area())),
      aovs_(frame.aovs, pixels_.size()),
      lightImage_(frame.bounds, filter) {}

double FilmSums::memory(const FilmFrame& frame) {
  const size_t pixel = sizeof(PixelSums) + AovSums::sumsPerPixel(frame.aovs) * sizeof(WideSum);
  return static_cast<double>(frame.bounds.area()) * static_cast<double>(pixel);
}

size_t FilmSums::index(const Int2& p) const {
  assert(frame_.bounds.contains(p));
  const Int2 local = p - frame_.bounds.min;
  return static_cast<size_t>(local.y) * static_cast<size_t>(frame_.bounds.size().x) +
         static_cast<size_t>(local.x);
}

void FilmSums::addSample(size_t pixel, const std::array<double, 3>& rgb, double luminance) {
  PixelSums& sums = pixels_[pixel];
  addBlack(pixel);
  add(sums.r, rgb[0]);
  add(sums.g, rgb[1]);
  add(sums.b, rgb[2]);
  store(sums.luminanceSquares, sums.luminanceSquares + sqr(luminance));
  aovs_.addColour(pixel, rgb);
}

void FilmSums::addBlack(size_t pixel) { store(pixels_[pixel].count, pixels_[pixel].count + 1); }

uint64_t FilmSums::sampleCount(size_t pixel) const { return load(pixels_[pixel].count); }

Rgb FilmSums::pixel(size_t i) const {
  const PixelSums& sums = pixels_[i];
  const uint64_t count = load(sums.count);
  const double factor = count > 0 ? 1 / static_cast<double>(count) : 0, scale = frame_.scale;
  const auto light = lightImage_.mean(i);
  return {toFloat((load(sums.r.high) * factor + light[0]) * scale),
          toFloat((load(sums.g.high) * factor + light[1]) * scale),
          toFloat((load(sums.b.high) * factor + light[2]) * scale)};
}

/// Of the samples alone: splats, which come from anywhere, keep no squares, but count for the mean.
/// Infinite as long as no pixel has two samples: nothing is known then, and nobody should stop.
double FilmSums::noise() const {
  double meanSum = 0, errorSum = 0;
  uint64_t pixels = 0;
  for (size_t i = 0; i < pixels_.size(); ++i) {
    const PixelSums& sums = pixels_[i];
    const uint64_t count = load(sums.count);
    if (count < 2) continue;
    const auto n = static_cast<double>(count);
    const double mean = (0.212671 * load(sums.r.high) + 0.715160 * load(sums.g.high) +
                         0.072169 * load(sums.b.high)) /
                        n;
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

void FilmSums::write(const std::string& path, const ImageMetadata& metadata) const {
  const Int2 size = frame_.bounds.size();
  Image image(size.x, size.y, 3);
  for (int y = 0; y < size.y; ++y)
    for (int x = 0; x < size.x; ++x)
      image.setRgb(x, y, pixel(index(frame_.bounds.min + Int2(x, y))));
  WriteOptions options;
  options.metadata = metadata;
  options.placement = {frame_.bounds.min, frame_.resolution};
  options.layers = aovs_.layers(pixels_, frame_.scale);
  writeImageFile(path, image, options);
}

std::string FilmSums::save() const {
  if (!lightImage_.isOpen()) return encodeSums(frame_, pixels_, aovs_.values(), 0);
  return encodeSums(frame_, pixels_, aovs_.values(), lightImage_.encodedSize()) +
         lightImage_.encode();
}

bool FilmSums::restore(std::string_view bytes) {
  if (decodeSums(bytes, frame_, pixels_, aovs_.values(), 0)) return true;
  const size_t tail = lightImage_.encodedSize();
  if (bytes.size() < tail) return false;
  const std::string_view light = bytes.substr(bytes.size() - tail);
  return LightImage::isIntact(light) &&
         decodeSums(bytes.substr(0, bytes.size() - tail), frame_, pixels_, aovs_.values(), tail) &&
         lightImage_.decode(light);
}

std::unique_ptr<FilmSums> FilmSums::decode(std::string_view bytes) {
  const auto frame = frameOfSums(bytes);
  const auto isSane = [&](const PixelBounds& b) {
    constexpr int kMost = 1 << 20;
    return b.min.x >= 0 && b.min.y >= 0 && b.max.x <= kMost && b.max.y <= kMost && b.area() > 0;
  };
  if (!frame || !isSane(frame->bounds) || memory(*frame) > static_cast<double>(bytes.size()))
    return nullptr;
  auto film = std::make_unique<FilmSums>(*frame);
  if (!film->restore(bytes)) film.reset();
  return film;
}

bool FilmSums::merge(const FilmSums& other) {
  if (!equal(frame_, other.frame_) || !lightImage_.merge(other.lightImage_)) return false;
  for (size_t i = 0; i < pixels_.size(); ++i) {
    PixelSums& to = pixels_[i];
    const PixelSums& from = other.pixels_[i];
    to.r += from.r;
    to.g += from.g;
    to.b += from.b;
    to.luminanceSquares += from.luminanceSquares;
    to.count += from.count;
  }
  const auto to = aovs_.values();
  const auto from = other.aovs_.values();
  for (size_t i = 0; i < to.size(); ++i) to[i] += from[i];
  return true;
}

}  // namespace lampyris
