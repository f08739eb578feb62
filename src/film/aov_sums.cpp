// SPDX-License-Identifier: Apache-2.0
#include "film/aov_sums.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include "core/math.h"

namespace lampyris {

namespace {

constexpr double kMicroseconds = 1e6;

/// How an AOV is kept and written.
struct Layout {
  Aov aov;
  std::array<const char*, 3> layers{};  ///< names of its channels
  size_t sums = 1;                      ///< Σ of values, one a channel
  bool weighted = false;  ///< divided by a sum of weights kept beside, not by the samples' count
};
constexpr std::array<Layout, kAovNames.size()> kLayouts = {{
    {Aov::Albedo, {"albedo.R", "albedo.G", "albedo.B"}, 3},
    {Aov::Normal, {"N.X", "N.Y", "N.Z"}, 3},
    {Aov::Depth, {"depth.Z"}, 1, true},
    {Aov::SampleCount, {"samplecount.Y"}, 0},
    {Aov::Variance, {"variance.R", "variance.G", "variance.B"}, 3},
    {Aov::LightCut, {"lightcut.Y"}, 1, true},
    {Aov::BsdfShare, {"bsdfshare.Y"}, 1, true},
    {Aov::BrdfSamples, {"brdfsamples.Y"}, 1, true},
    {Aov::BsdfDraws, {"bsdfdraws.Y"}, 1, true},
    {Aov::LightEntropy, {"lightentropy.Y"}, 1, true},
    {Aov::PathLength, {"pathlength.Y"}},
    {Aov::Time, {"time.Y"}},
}};
constexpr bool layoutsAreInOrder() {
  for (size_t i = 0; i < kLayouts.size(); ++i)
    if (static_cast<size_t>(kLayouts[i].aov) != i) return false;
  return true;
}
static_assert(layoutsAreInOrder());

/// What a path adds to the sums of an AOV, and to its weight.
struct Contribution {
  std::array<double, 3> values{};
  double weight = 0;
};

Contribution contributionOf(Aov aov, const AovRecord& r) {
  const auto number = [](auto v) { return static_cast<double>(v); };
  switch (aov) {
    case Aov::Albedo:
      return {{number(r.albedo.r), number(r.albedo.g), number(r.albedo.b)}};
    case Aov::Normal:
      return {{number(r.normal.x), number(r.normal.y), number(r.normal.z)}};
    case Aov::Depth:
      return {{number(r.depth)}, r.seen ? 1. : 0.};
    case Aov::LightCut:
      return {{number(r.draws)}, r.hasLightVertex() ? 1. : 0.};
    case Aov::BsdfShare:
      return {{r.bsdfPart}, r.bsdfPart + r.lightPart};
    case Aov::BrdfSamples:
      return {{number(r.brdfSamples)}, r.hasLightVertex() ? 1. : 0.};
    case Aov::BsdfDraws:
      return {{number(r.bsdfDraws)}, number(r.brdfSamples)};
    case Aov::LightEntropy:
      return {{r.information}, number(r.draws)};
    case Aov::PathLength:
      return {{number(r.segments)}};
    case Aov::Time:
      return {{r.seconds * kMicroseconds}};
    case Aov::SampleCount:
    case Aov::Variance:
      break;
  }
  return {};
}

float toFloat(double v) {
  constexpr double kMax = std::numeric_limits<float>::max();
  return std::isfinite(v) ? static_cast<float>(std::clamp(v, -kMax, kMax)) : 0.f;
}

/// Squared standard error of the mean of n samples, given Σx and Σx².
double varianceOfMean(double sum, double squares, double n) {
  return n < 2 ? 0 : std::max(0., squares / n - sqr(sum / n)) / (n - 1);
}

double layerValue(const Layout& layout, size_t channel, const PixelSums& pixel, const WideSum* sums,
                  double scale) {
  const auto n = static_cast<double>(pixel.count);
  if (layout.aov == Aov::SampleCount) return n;
  if (layout.aov == Aov::Variance) {
    const std::array<double, 3> rgb{pixel.r.high, pixel.g.high, pixel.b.high};
    return sqr(scale) * varianceOfMean(rgb[channel], sums[channel].high, n);
  }
  const double divisor = layout.weighted ? sums[layout.sums].high : n;
  return divisor > 0 ? sums[channel].high / divisor : 0;
}

}  // namespace

AovSums::AovSums(AovSet set, size_t pixels) : set_(set) {
  for (const Layout& l : kLayouts) {
    if (!set.has(l.aov)) continue;
    offset_[static_cast<size_t>(l.aov)] = stride_;
    stride_ += l.sums + (l.weighted ? 1 : 0);
  }
  values_.resize(stride_ * pixels);
}

size_t AovSums::sumsPerPixel(AovSet set) { return AovSums(set, 0).stride_; }

WideSum* AovSums::of(size_t pixel, Aov aov) {
  return values_.data() + pixel * stride_ + offset_[static_cast<size_t>(aov)];
}
const WideSum* AovSums::of(size_t pixel, Aov aov) const {
  return values_.data() + pixel * stride_ + offset_[static_cast<size_t>(aov)];
}

void AovSums::add(size_t pixel, const AovRecord& record) {
  for (const Layout& l : kLayouts) {
    if (!set_.has(l.aov) || l.sums == 0) continue;
    const Contribution c = contributionOf(l.aov, record);
    if (!std::isfinite(c.values[0] + c.values[1] + c.values[2] + c.weight)) continue;
    WideSum* const sums = of(pixel, l.aov);
    for (size_t i = 0; i < l.sums; ++i) sums[i].add(c.values[i]);
    if (l.weighted) sums[l.sums].add(c.weight);
  }
}

void AovSums::addColour(size_t pixel, const std::array<double, 3>& rgb) {
  if (!set_.has(Aov::Variance)) return;
  WideSum* const squares = of(pixel, Aov::Variance);
  for (size_t c = 0; c < rgb.size(); ++c) squares[c].add(sqr(rgb[c]));
}

std::vector<ImageLayer> AovSums::layers(std::span<const PixelSums> pixels, double scale) const {
  std::vector<ImageLayer> layers;
  for (const Layout& l : kLayouts) {
    if (!set_.has(l.aov)) continue;
    for (size_t c = 0; c < l.layers.size() && l.layers[c]; ++c) {
      ImageLayer& layer = layers.emplace_back(ImageLayer{l.layers[c], {}});
      layer.values.reserve(pixels.size());
      for (size_t i = 0; i < pixels.size(); ++i)
        layer.values.push_back(toFloat(layerValue(l, c, pixels[i], of(i, l.aov), scale)));
    }
  }
  return layers;
}

}  // namespace lampyris
