// SPDX-License-Identifier: Apache-2.0
/// The part of an image that paths make which choose their place on the film themselves.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/filter.h"
#include "core/bounds.h"
#include "core/rgb.h"

namespace lampyris {

/// Sums in 64-bit fixed point: integers add up to the same in any order, so threads need no locks
/// to agree. Nothing is allocated until it is opened.
class LightImage {
 public:
  /// `filter` must live as long; null: add() is not called.
  LightImage(const PixelBounds& bounds, const Filter* filter) : bounds_(bounds), filter_(filter) {}

  bool isOpen() const { return unit_ > 0; }
  /// See Film::openLightImage(). Once it is open nothing changes.
  void open(double typical);
  /// Adds to every pixel near `film` by the filter's weight there. `value` must be finite. From any
  /// thread.
  void add(const Vec2& film, const Rgb& value);
  void addPaths(uint64_t count) { paths_.fetch_add(count, std::memory_order_relaxed); }
  /// Of a pixel (row by row), over the paths that it has had.
  std::array<double, 3> mean(size_t pixel) const;

  /// Adds another's sums and paths; false, and nothing happens, if they are in other units.
  bool merge(const LightImage& other);

  /// Header, sums, checksum. encodedSize() does not depend on whether it is open.
  std::string encode() const;
  size_t encodedSize() const;
  /// Back, and opens it. False, and nothing happens, if the bytes are damaged.
  bool decode(std::string_view bytes);
  static bool isIntact(std::string_view bytes);

 private:
  void allocate();

  const PixelBounds bounds_;
  const Filter* const filter_;
  double unit_ = 0;          ///< of the sums; a power of two
  double filterFactor_ = 1;  ///< 1 / ∫ filter
  std::atomic<uint64_t> paths_{0};
  std::vector<int64_t> sums_;  ///< three a pixel
};

}  // namespace lampyris
