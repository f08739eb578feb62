// SPDX-License-Identifier: Apache-2.0
/// Images at all sizes, for filtered look-ups.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "core/rgb.h"
#include "core/vector.h"

namespace lampyris {

/// What lies beyond the image.
enum class ImageWrap : uint8_t { Repeat, Black, Clamp };

/// A pyramid of images, each half the size of the one below it, of T = float or Rgb. The square
/// [0, 1]² covers the image; (0, 0) is its lower left corner. Look-ups are those of pbrt-v3: texel
/// centres at (i + 0.5) / size, bilinear, trilinear or with elliptical Gaussians. Footprints are in
/// the same units. Look-ups take any numbers, not finite ones too.
template <class T>
class ImagePyramid {
 public:
  /// `texels` row by row from the bottom. A size that is no power of two is enlarged to the next
  /// one (Lanczos filter, negative results clipped).
  ImagePyramid(int width, int height, std::vector<T> texels, ImageWrap wrap);

  int levelCount() const { return static_cast<int>(levels_.size()); }
  Int2 size(int level) const { return {at(level).width, at(level).height}; }
  T texel(int level, int s, int t) const { return fetch(at(level), s, t); }

  T bilinear(int level, const Vec2& st) const {
    const Level& l = at(level);
    const float s = bounded(st.x * static_cast<float>(l.width) - 0.5f);
    const float t = bounded(st.y * static_cast<float>(l.height) - 0.5f);
    const float s0 = std::floor(s), t0 = std::floor(t);
    const float ds = s - s0, dt = t - t0;
    const int i = static_cast<int>(s0), j = static_cast<int>(t0);
    return (1 - dt) * ((1 - ds) * fetch(l, i, j) + ds * fetch(l, i + 1, j)) +
           dt * ((1 - ds) * fetch(l, i, j + 1) + ds * fetch(l, i + 1, j + 1));
  }
  /// Filtered over a square of side `width`.
  T trilinear(const Vec2& st, float width) const;
  /// Filtered over the ellipse with the conjugate radii `d0` and `d1`, made rounder where one axis
  /// is more than `maxAnisotropy` times the other.
  T elliptical(const Vec2& st, Vec2 d0, Vec2 d1, float maxAnisotropy) const;

 private:
  struct Level {
    int width = 0, height = 0;
    std::vector<T> texels;
  };

  /// Within what an int holds; NaN becomes a number.
  static float bounded(float x) {
    constexpr float kMax = 1e9f;
    return std::max(-kMax, std::min(kMax, x));
  }
  const Level& at(int level) const { return levels_[static_cast<size_t>(level)]; }
  const T& top() const { return levels_.back().texels[0]; }

  /// The index in [0, size), or −1 for what is black. Sizes are powers of two.
  int wrapped(int i, int size) const {
    if (wrap_ == ImageWrap::Repeat) return i & (size - 1);
    if (wrap_ == ImageWrap::Clamp) return std::clamp(i, 0, size - 1);
    return i >= 0 && i < size ? i : -1;
  }
  T fetch(const Level& l, int s, int t) const {
    s = wrapped(s, l.width);
    t = wrapped(t, l.height);
    if ((s | t) < 0) return T{};
    return l.texels[static_cast<size_t>(t) * static_cast<size_t>(l.width) + static_cast<size_t>(s)];
  }
  T ellipticalAt(int level, const Vec2& st, const Vec2& d0, const Vec2& d1) const;

  std::vector<Level> levels_;
  ImageWrap wrap_;
};

extern template class ImagePyramid<float>;
extern template class ImagePyramid<Rgb>;

}  // namespace lampyris
