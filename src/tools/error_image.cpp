// SPDX-License-Identifier: Apache-2.0
#include "tools/error_image.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <vector>

#include "core/spectrum.h"
#include "tools/image_pairs.h"

namespace lampyris {

namespace {

constexpr Rgb kNotFiniteColour{0, 1, 0};

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
  const double epsilon = count > 0 ? relativeFloor(sum / count) : 0;
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
