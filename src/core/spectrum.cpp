// SPDX-License-Identifier: Apache-2.0
#include "core/spectrum.h"

#include <algorithm>
#include <vector>

#include "core/cie1931.h"
#include "core/math.h"

namespace lampyris {

namespace {

/// ∫ȳ dλ as tabulated at 1 nm, the constant that pbrt-v3 divides by.
constexpr double kCieYIntegral = 106.856895;

double matchingFunction(double lambda, size_t c) {
  const double at = (lambda - static_cast<double>(kCieFirst)) / static_cast<double>(kCieStep);
  const auto last = static_cast<double>(kCie1931.size() - 1);
  if (at < 0 || at > last) return 0;
  const auto i = static_cast<size_t>(std::min(at, last - 1));
  const double t = at - static_cast<double>(i);
  return (1 - t) * static_cast<double>(kCie1931[i][c]) +
         t * static_cast<double>(kCie1931[i + 1][c]);
}

/// Integrates value(λ) against the matching functions.
template <class Value>
Rgb integrate(const Value& value) {
  double xyz[3] = {0, 0, 0};
  for (int nm = 360; nm <= 830; ++nm) {
    const double v = value(nm);
    for (size_t c = 0; c < 3; ++c) xyz[c] += v * matchingFunction(nm, c);
  }
  const double scale = 470. / (471. * kCieYIntegral);
  return xyzToRgb(Vec3(xyz[0] * scale, xyz[1] * scale, xyz[2] * scale));
}

}  // namespace

Rgb xyzToRgb(const Vec3& c) {
  return {3.240479f * c.x - 1.537150f * c.y - 0.498535f * c.z,
          -0.969256f * c.x + 1.875991f * c.y + 0.041556f * c.z,
          0.055648f * c.x - 0.204043f * c.y + 1.057311f * c.z};
}

Rgb spectrumToRgb(std::span<const float> pairs) {
  struct Point {
    double lambda, value;
  };
  std::vector<Point> points;
  for (size_t i = 0; i + 1 < pairs.size(); i += 2)
    points.push_back({static_cast<double>(pairs[i]), static_cast<double>(pairs[i + 1])});
  if (points.empty()) return Rgb();
  std::stable_sort(points.begin(), points.end(),
                   [](const Point& a, const Point& b) { return a.lambda < b.lambda; });
  return integrate([&points](double lambda) {
    if (lambda <= points.front().lambda) return points.front().value;
    if (lambda >= points.back().lambda) return points.back().value;
    const auto above = std::upper_bound(points.begin(), points.end(), lambda,
                                        [](double l, const Point& p) { return l < p.lambda; });
    const auto below = above - 1;
    const double t = (lambda - below->lambda) / (above->lambda - below->lambda);
    return (1 - t) * below->value + t * above->value;
  });
}

Rgb blackbodyRgb(float kelvin) {
  if (!(kelvin > 0) || !std::isfinite(kelvin)) return Rgb();
  // Planck's law; its constants drop out of the ratio but for c2 = hc/k, and Wien's displacement.
  constexpr double c2 = 1.4387769e7;  // nm K
  const auto t = static_cast<double>(kelvin);
  const auto planck = [t](double nm) { return std::pow(nm, -5) / std::expm1(c2 / (nm * t)); };
  const double peak = planck(2.8977721e6 / t);
  return integrate([&planck, peak](double nm) { return planck(nm) / peak; });
}

}  // namespace lampyris
