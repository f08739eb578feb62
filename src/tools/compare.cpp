// SPDX-License-Identifier: Apache-2.0
#include "tools/compare.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "core/math.h"
#include "core/spectrum.h"

namespace lampyris {

namespace {

constexpr double kRelativeFloor = 0.01;  // of the reference's mean
constexpr double kTrimmedShare = 0.001;
constexpr Rgb kNotFiniteColour{0, 1, 0};

std::array<double, 3> channels(const Rgb& c) {
  return {static_cast<double>(c.r), static_cast<double>(c.g), static_cast<double>(c.b)};
}

std::string sizeError(const Image& a, const Image& b) {
  if (a.empty() || b.empty()) return "an image without pixels cannot be compared";
  if (a.width() == b.width() && a.height() == b.height()) return "";
  return fmt::format("the images differ in size: {} x {} and {} x {} pixels", a.width(), a.height(),
                     b.width(), b.height());
}

/// Calls f(x, y, a, b) for the pixels where both images are finite; returns how many are not.
template <class F>
size_t forFinitePixels(const Image& image, const Image& reference, F&& f) {
  size_t skipped = 0;
  for (int y = 0; y < image.height(); ++y)
    for (int x = 0; x < image.width(); ++x) {
      const Rgb a = image.rgb(x, y), b = reference.rgb(x, y);
      if (a.isFinite() && b.isFinite()) {
        f(x, y, channels(a), channels(b));
      } else {
        ++skipped;
      }
    }
  return skipped;
}

/// Mean over the channels of (a − b)² / (b² + ε).
double relativeSquare(const std::array<double, 3>& a, const std::array<double, 3>& b,
                      double epsilon) {
  double sum = 0;
  for (size_t c = 0; c < 3; ++c) sum += sqr(a[c] - b[c]) / (sqr(b[c]) + epsilon);
  return sum / 3;
}

double floorOf(double meanReference) { return sqr(kRelativeFloor * meanReference); }

std::string figure(const std::optional<double>& v) {
  return v ? fmt::format("{:.6g}", *v) : "undefined (the reference's mean is 0)";
}

/// CIE XYZ of a CIELAB colour with the white point D65, which sRGB's white has.
Vec3 labToXyz(float lightness, float a, float b) {
  constexpr float kDelta = 6.f / 29;
  const auto cube = [](float t) {
    return t > kDelta ? t * t * t : 3 * kDelta * kDelta * (t - 4.f / 29);
  };
  const float f = (lightness + 16) / 116;
  return {0.950456f * cube(f + a / 500), cube(f), 1.088754f * cube(f - b / 200)};
}

}  // namespace

Comparison compareImages(const Image& image, const Image& reference) {
  Comparison result;
  result.error = sizeError(image, reference);
  if (!result.error.empty()) return result;

  double sumA = 0, sumB = 0, squares = 0, absolutes = 0;
  size_t compared = 0;
  result.notFinite = forFinitePixels(image, reference, [&](int, int, const auto& a, const auto& b) {
    ++compared;
    for (size_t c = 0; c < 3; ++c) {
      const double d = std::abs(a[c] - b[c]);
      sumA += a[c];
      sumB += b[c];
      squares += d * d;
      absolutes += d;
      result.maxError = std::max(result.maxError, d);
    }
  });
  result.pixels = compared;
  if (compared == 0) {
    result.error = "no pixel is finite in both images";
    return result;
  }
  const double count = 3 * static_cast<double>(compared);
  result.meanImage = sumA / count;
  result.meanReference = sumB / count;
  result.mse = squares / count;
  result.rmse = std::sqrt(result.mse);
  result.mae = absolutes / count;
  const double epsilon = floorOf(result.meanReference);
  if (!(epsilon > 0)) return result;

  result.meanRatio = result.meanImage / result.meanReference;
  std::vector<double> terms;
  terms.reserve(compared);
  forFinitePixels(image, reference, [&](int, int, const auto& a, const auto& b) {
    terms.push_back(relativeSquare(a, b, epsilon));
  });
  // Rounded up, so that a single firefly in a small image is left out as well.
  const auto trimmed =
      static_cast<size_t>(std::ceil(kTrimmedShare * static_cast<double>(terms.size())));
  const size_t kept = terms.size() - trimmed;
  std::nth_element(terms.begin(), terms.begin() + static_cast<std::ptrdiff_t>(kept), terms.end());
  double keptSum = 0, trimmedSum = 0;
  for (size_t i = 0; i < terms.size(); ++i) (i < kept ? keptSum : trimmedSum) += terms[i];
  result.relMse = (keptSum + trimmedSum) / static_cast<double>(terms.size());
  result.trimmedRelMse = kept > 0 ? keptSum / static_cast<double>(kept) : *result.relMse;
  return result;
}

std::string formatComparison(const Comparison& c) {
  if (!c.error.empty()) return c.error + "\n";
  std::string text;
  const auto line = [&text](std::string_view name, const std::string& value) {
    text += fmt::format("{:<16}{}\n", name, value);
  };
  line("MSE", figure(c.mse));
  line("RMSE", figure(c.rmse));
  line("MAE", figure(c.mae));
  line("max error", figure(c.maxError));
  line("relMSE", figure(c.relMse));
  line("relMSE, trimmed", figure(c.trimmedRelMse));
  line("mean", figure(c.meanImage));
  line("reference mean", figure(c.meanReference));
  line("mean ratio", figure(c.meanRatio));
  if (c.notFinite > 0)
    line("left out", fmt::format("{} pixels that are infinite or not a number", c.notFinite));
  return text;
}

Rgb errorColour(float t) {
  // A spiral in CIELAB: lightness grows linearly, the hue turns from violet (310°) over red to
  // yellow (100°), and the chroma vanishes at both ends. Chroma that a screen cannot show is
  // reduced at constant lightness, so the order of lightness holds exactly.
  t = t > 0 ? std::min(t, 1.f) : 0.f;
  const float lightness = 100 * t;
  const float hue = (310 + 150 * t) * kPi / 180;
  float chroma = 4 * 75 * t * (1 - t), step = chroma;
  const auto colour = [&](float c) {
    return xyzToRgb(labToXyz(lightness, c * std::cos(hue), c * std::sin(hue)));
  };
  const auto shown = [](const Rgb& c) {
    return std::min({c.r, c.g, c.b}) >= 0 && c.maxComponent() <= 1;
  };
  if (!shown(colour(chroma))) {
    chroma = 0;
    for (int i = 0; i < 16; ++i) {
      step /= 2;
      if (shown(colour(chroma + step))) chroma += step;
    }
  }
  const Rgb c = colour(chroma);
  return {std::clamp(c.r, 0.f, 1.f), std::clamp(c.g, 0.f, 1.f), std::clamp(c.b, 0.f, 1.f)};
}

Image errorImage(const Image& image, const Image& reference) {
  constexpr double kDecades = 3;  // below 1
  constexpr size_t kColours = 1024;
  const std::string fault = sizeError(image, reference);
  if (!fault.empty()) throw std::invalid_argument(fault);
  std::vector<Rgb> map(kColours + 1);
  for (size_t i = 0; i <= kColours; ++i)
    map[i] = errorColour(static_cast<float>(i) / static_cast<float>(kColours));

  double sum = 0, count = 0;
  forFinitePixels(image, reference, [&](int, int, const auto&, const auto& b) {
    sum += b[0] + b[1] + b[2];
    count += 3;
  });
  const double epsilon = count > 0 ? floorOf(sum / count) : 0;
  Image out(image.width(), image.height(), 3);
  for (int y = 0; y < out.height(); ++y)
    for (int x = 0; x < out.width(); ++x) out.setRgb(x, y, kNotFiniteColour);
  forFinitePixels(image, reference, [&](int x, int y, const auto& a, const auto& b) {
    double t = 0;
    if (a != b) {
      const double e = relativeSquare(a, b, epsilon);
      t = std::isfinite(e) ? std::clamp(1 + 0.5 * std::log10(e) / kDecades, 0., 1.) : 1;
    }
    out.setRgb(x, y, map[static_cast<size_t>(std::lround(t * static_cast<double>(kColours)))]);
  });
  return out;
}

}  // namespace lampyris
