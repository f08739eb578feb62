// SPDX-License-Identifier: Apache-2.0
// Williams 1983, "Pyramidal Parametrics"; Heckbert 1989, "Fundamentals of Texture Mapping and Image
// Warping" (elliptical weighted average); with the constants of pbrt-v3 (Pharr et al. 2016, §10.4).
// Deviation: where a level is one texel wide or high, the next one averages along the other axis
// only; pbrt-v3 averages with black there if what lies beyond the image is black.
#include "textures/image_pyramid.h"

#include <array>
#include <bit>
#include <cassert>

#include "core/math.h"
#include "core/parallel.h"

namespace lampyris {

namespace {

constexpr int kTaps = 4;
constexpr float kLanczosRadius = 2, kLanczosTau = 2;
constexpr size_t kGaussianEntries = 128;
constexpr float kGaussianAlpha = 2;

/// exp(−α r²) − exp(−α) over r² in [0, 1].
const std::array<float, kGaussianEntries> kGaussian = [] {
  std::array<float, kGaussianEntries> table{};
  for (size_t i = 0; i < kGaussianEntries; ++i) {
    const float r2 = static_cast<float>(i) / static_cast<float>(kGaussianEntries - 1);
    table[i] = std::exp(-kGaussianAlpha * r2) - std::exp(-kGaussianAlpha);
  }
  return table;
}();

/// The Lanczos-windowed sinc; 0 beyond |x| = 1.
float lanczos(float x) {
  x = std::abs(x) * kPi;
  if (x < 1e-5f * kPi) return 1;
  if (x > kPi) return 0;
  return std::sin(x * kLanczosTau) / (x * kLanczosTau) * std::sin(x) / x;
}

/// The input texels that make up one output texel.
struct Taps {
  int first = 0;
  std::array<float, kTaps> weights{};
};

std::vector<Taps> resamplingTaps(int from, int to) {
  std::vector<Taps> all(static_cast<size_t>(to));
  for (int i = 0; i < to; ++i) {
    Taps& taps = all[static_cast<size_t>(i)];
    const float centre =
        (static_cast<float>(i) + 0.5f) * static_cast<float>(from) / static_cast<float>(to);
    taps.first = static_cast<int>(std::floor(centre - kLanczosRadius + 0.5f));
    float sum = 0;
    for (int j = 0; j < kTaps; ++j) {
      const float position = static_cast<float>(taps.first + j) + 0.5f;
      sum += taps.weights[static_cast<size_t>(j)] = lanczos((position - centre) / kLanczosRadius);
    }
    for (float& w : taps.weights) w /= sum;
  }
  return all;
}

/// For sizes that need not be powers of two; −1 for what is black.
int wrapAny(int i, int size, ImageWrap wrap) {
  if (wrap == ImageWrap::Repeat) return ((i % size) + size) % size;
  if (wrap == ImageWrap::Clamp) return std::clamp(i, 0, size - 1);
  return i >= 0 && i < size ? i : -1;
}

float positive(float v) { return std::max(v, 0.f); }
Rgb positive(const Rgb& v) { return clampPositive(v); }

size_t cell(int x, int y, int width) {
  return static_cast<size_t>(y) * static_cast<size_t>(width) + static_cast<size_t>(x);
}

template <class T>
std::vector<T> resample(const std::vector<T>& texels, const Int2& from, const Int2& to,
                        ImageWrap wrap) {
  const std::vector<Taps> columns = resamplingTaps(from.x, to.x);
  std::vector<T> wide(static_cast<size_t>(to.x) * static_cast<size_t>(from.y));
  parallelFor(static_cast<size_t>(from.y), 8, [&](size_t begin, size_t end) {
    for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y)
      for (int x = 0; x < to.x; ++x) {
        const Taps& taps = columns[static_cast<size_t>(x)];
        T& sum = wide[cell(x, y, to.x)];
        for (int j = 0; j < kTaps; ++j) {
          const int i = wrapAny(taps.first + j, from.x, wrap);
          if (i >= 0) sum += taps.weights[static_cast<size_t>(j)] * texels[cell(i, y, from.x)];
        }
      }
  });
  const std::vector<Taps> rows = resamplingTaps(from.y, to.y);
  std::vector<T> result(static_cast<size_t>(to.x) * static_cast<size_t>(to.y));
  parallelFor(static_cast<size_t>(to.y), 8, [&](size_t begin, size_t end) {
    for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y) {
      const Taps& taps = rows[static_cast<size_t>(y)];
      for (int x = 0; x < to.x; ++x) {
        T sum{};
        for (int j = 0; j < kTaps; ++j) {
          const int i = wrapAny(taps.first + j, from.y, wrap);
          if (i >= 0) sum += taps.weights[static_cast<size_t>(j)] * wide[cell(x, i, to.x)];
        }
        result[cell(x, y, to.x)] = positive(sum);
      }
    }
  });
  return result;
}

template <class T>
T mix(float t, const T& a, const T& b) {
  return (1 - t) * a + t * b;
}

}  // namespace

template <class T>
ImagePyramid<T>::ImagePyramid(int width, int height, std::vector<T> texels, ImageWrap wrap)
    : wrap_(wrap) {
  assert(width > 0 && height > 0 && texels.size() == cell(0, height, width));
  const auto powerOfTwo = [](int n) {
    return static_cast<int>(std::bit_ceil(static_cast<unsigned>(n)));
  };
  const Int2 size(powerOfTwo(width), powerOfTwo(height));
  if (size != Int2(width, height)) texels = resample(texels, {width, height}, size, wrap);
  levels_.push_back({size.x, size.y, std::move(texels)});
  while (levels_.back().width > 1 || levels_.back().height > 1) {
    const Level& below = levels_.back();
    Level level{std::max(below.width / 2, 1), std::max(below.height / 2, 1), {}};
    level.texels.resize(cell(0, level.height, level.width));
    const int right = below.width > 1 ? 1 : 0, up = below.height > 1 ? 1 : 0;
    parallelFor(static_cast<size_t>(level.height), 16, [&](size_t begin, size_t end) {
      for (int y = static_cast<int>(begin); y < static_cast<int>(end); ++y)
        for (int x = 0; x < level.width; ++x) {
          const auto source = [&](int dx, int dy) -> const T& {
            return below.texels[cell(2 * x * right + dx, 2 * y * up + dy, below.width)];
          };
          level.texels[cell(x, y, level.width)] =
              0.25f * (source(0, 0) + source(right, 0) + source(0, up) + source(right, up));
        }
    });
    levels_.push_back(std::move(level));
  }
}

template <class T>
T ImagePyramid<T>::trilinear(const Vec2& st, float width) const {
  const int last = levelCount() - 1;
  const float level = static_cast<float>(last) + std::log2(std::max(width, 1e-8f));
  if (!(level >= 0)) return bilinear(0, st);
  if (level >= static_cast<float>(last)) return top();
  const int below = static_cast<int>(level);
  return mix(level - static_cast<float>(below), bilinear(below, st), bilinear(below + 1, st));
}

template <class T>
T ImagePyramid<T>::elliptical(const Vec2& st, Vec2 d0, Vec2 d1, float maxAnisotropy) const {
  float major2 = dot(d0, d0), minor2 = dot(d1, d1);
  if (major2 < minor2) {
    std::swap(d0, d1);
    std::swap(major2, minor2);
  }
  if (!std::isfinite(major2)) return top();
  const float major = std::sqrt(major2);
  float minor = std::sqrt(minor2);
  if (minor > 0 && minor * maxAnisotropy < major) {
    const float enlarge = major / (minor * maxAnisotropy);
    d1 *= enlarge;
    minor *= enlarge;
  }
  if (!(minor > 0) || !std::isfinite(minor)) return bilinear(0, st);
  const int last = levelCount() - 1;
  const float level = std::max(0.f, static_cast<float>(last) + std::log2(minor));
  if (level >= static_cast<float>(last)) {
    // Between the top level, which is one texel, and what would be above it.
    if (level >= static_cast<float>(last + 1)) return top();
    return mix(level - static_cast<float>(last), ellipticalAt(last, st, d0, d1), top());
  }
  const int below = static_cast<int>(level);
  return mix(level - static_cast<float>(below), ellipticalAt(below, st, d0, d1),
             ellipticalAt(below + 1, st, d0, d1));
}

template <class T>
T ImagePyramid<T>::ellipticalAt(int level, const Vec2& st, const Vec2& d0, const Vec2& d1) const {
  const Level& l = at(level);
  const Vec2 size(l.width, l.height);
  const Vec2 centre(bounded(st.x * size.x - 0.5f), bounded(st.y * size.y - 0.5f));
  const Vec2 e0 = d0 * size, e1 = d1 * size;

  // The ellipse A s² + B s t + C t² < F, widened so that it covers a texel at least.
  const float a = sqr(e0.y) + sqr(e1.y) + 1;
  const float b = -2 * (e0.x * e0.y + e1.x * e1.y);
  const float c = sqr(e0.x) + sqr(e1.x) + 1;
  // A C − B²/4, without the cancellation.
  const float f = sqr(e0.x * e1.y - e0.y * e1.x) + a + c - 1;
  // Half the sides of its bounding box are √C and √A.
  const float radiusS = std::sqrt(c), radiusT = std::sqrt(a);
  const int s0 = static_cast<int>(std::ceil(centre.x - radiusS));
  const int s1 = static_cast<int>(std::floor(centre.x + radiusS));
  const int t0 = static_cast<int>(std::ceil(centre.y - radiusT));
  const int t1 = static_cast<int>(std::floor(centre.y + radiusT));

  T sum{};
  float weights = 0;
  for (int t = t0; t <= t1; ++t) {
    const float y = static_cast<float>(t) - centre.y;
    for (int s = s0; s <= s1; ++s) {
      const float x = static_cast<float>(s) - centre.x;
      const float r2 = (a * x * x + b * x * y + c * y * y) / f;
      if (!(r2 < 1)) continue;
      const auto entry = static_cast<size_t>(r2 * static_cast<float>(kGaussianEntries));
      const float weight = kGaussian[std::min(entry, kGaussianEntries - 1)];
      sum += weight * fetch(l, s, t);
      weights += weight;
    }
  }
  return weights > 0 ? sum * (1 / weights) : bilinear(level, st);
}

template class ImagePyramid<float>;
template class ImagePyramid<Rgb>;

}  // namespace lampyris
