// SPDX-License-Identifier: Apache-2.0
#include "film/light_image.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstring>

#include "core/rejections.h"
#include "film/pixel_sums.h"

namespace lampyris {

namespace {

/// Steps below the typical value: finer than a float's digits, with 2³⁷ of it up to the end.
constexpr int kFractionBits = 26;
/// One value beyond this many steps counts as this: 2¹² of them have room in a sum.
constexpr double kLargest = 0x1p50;

struct Header {
  std::array<char, 8> magic{'L', 'A', 'M', 'P', 'L', 'I', 'G', 'H'};
  double unit = 0;
  uint64_t paths = 0;
};

int64_t load(const int64_t& v) {
  return std::atomic_ref<int64_t>(const_cast<int64_t&>(v)).load(std::memory_order_relaxed);
}

/// By midpoints; the filters' own tables are not finer.
double integralOf(const Filter& filter) {
  constexpr int kSide = 256;
  const Vec2 r = filter.radius();
  double sum = 0;
  for (int y = 0; y < kSide; ++y)
    for (int x = 0; x < kSide; ++x) {
      const Vec2 at = (Vec2(x, y) + 0.5f) / static_cast<float>(kSide);
      sum += static_cast<double>(filter.evaluate((2.f * at - 1.f) * r));
    }
  return sum / (kSide * kSide) * 4 * static_cast<double>(r.x) * static_cast<double>(r.y);
}

}  // namespace

void LightImage::allocate() {
  sums_.assign(3 * static_cast<size_t>(bounds_.area()), 0);
  if (!filter_) return;
  filterFactor_ = 1 / integralOf(*filter_);
  if (!std::isfinite(filterFactor_)) filterFactor_ = 0;
}

void LightImage::open(double typical) {
  assert(typical > 0 && std::isfinite(typical));
  if (isOpen()) return;
  allocate();
  unit_ = std::ldexp(1., std::clamp(std::ilogb(typical), -900, 900) - kFractionBits);
}

void LightImage::add(const Vec2& film, const Rgb& value) {
  const Vec2 radius = filter_->radius(), at = film - 0.5f;
  // Clamped as floats: far outside of the image they are no integers.
  const Vec2 low(bounds_.min), high(bounds_.max - 1);
  const Vec2 first = glm::max(glm::ceil(at - radius), low);
  const Vec2 last = glm::min(glm::floor(at + radius), high);
  if (!(first.x <= last.x && first.y <= last.y)) return;
  const Int2 begin(first), end(last);
  for (int y = begin.y; y <= end.y; ++y)
    for (int x = begin.x; x <= end.x; ++x) {
      const Vec2 offset = at - Vec2(x, y);
      const double weight = static_cast<double>(filter_->evaluate(offset)) * filterFactor_;
      if (weight == 0) continue;
      const Int2 local = Int2(x, y) - bounds_.min;
      const size_t pixel = static_cast<size_t>(local.y) * static_cast<size_t>(bounds_.size().x) +
                           static_cast<size_t>(local.x);
      const std::array<float, 3> rgb{value.r, value.g, value.b};
      for (size_t c = 0; c < 3; ++c) {
        const double steps = weight * static_cast<double>(rgb[c]) / unit_;
        if (!(std::abs(steps) <= kLargest)) countRejection(Rejection::DarkenedSplat);
        const auto whole =
            static_cast<int64_t>(std::nearbyint(std::clamp(steps, -kLargest, kLargest)));
        std::atomic_ref<int64_t>(sums_[3 * pixel + c]).fetch_add(whole, std::memory_order_relaxed);
      }
    }
}

std::array<double, 3> LightImage::mean(size_t pixel) const {
  const uint64_t paths = paths_.load(std::memory_order_relaxed);
  if (!isOpen() || paths == 0) return {0, 0, 0};
  const double factor = unit_ * static_cast<double>(bounds_.area()) / static_cast<double>(paths);
  std::array<double, 3> rgb{};
  for (size_t c = 0; c < 3; ++c) rgb[c] = static_cast<double>(load(sums_[3 * pixel + c])) * factor;
  return rgb;
}

bool LightImage::merge(const LightImage& other) {
  if (!other.isOpen()) return true;
  if (!isOpen()) {
    allocate();
    unit_ = other.unit_;
  }
  if (unit_ != other.unit_) return false;
  for (size_t i = 0; i < sums_.size(); ++i) sums_[i] += other.sums_[i];
  paths_ += other.paths_;
  return true;
}

size_t LightImage::encodedSize() const {
  return sizeof(Header) + 3 * sizeof(int64_t) * static_cast<size_t>(bounds_.area()) +
         sizeof(uint64_t);
}

std::string LightImage::encode() const {
  Header header;
  header.unit = unit_;
  header.paths = paths_.load(std::memory_order_relaxed);
  std::string bytes;
  bytes.reserve(encodedSize());
  bytes.append(reinterpret_cast<const char*>(&header), sizeof header);
  bytes.append(reinterpret_cast<const char*>(sums_.data()), sums_.size() * sizeof(int64_t));
  const uint64_t sum = checksum(bytes.data(), bytes.size());
  bytes.append(reinterpret_cast<const char*>(&sum), sizeof sum);
  return bytes;
}

bool LightImage::isIntact(std::string_view bytes) {
  Header header;
  uint64_t sum = 0;
  if (bytes.size() < sizeof header + sizeof sum) return false;
  const size_t body = bytes.size() - sizeof sum;
  std::memcpy(&header, bytes.data(), sizeof header);
  std::memcpy(&sum, bytes.data() + body, sizeof sum);
  return header.magic == Header().magic && header.unit > 0 && std::isfinite(header.unit) &&
         sum == checksum(bytes.data(), body);
}

bool LightImage::decode(std::string_view bytes) {
  if (bytes.size() != encodedSize() || !isIntact(bytes)) return false;
  Header header;
  std::memcpy(&header, bytes.data(), sizeof header);
  allocate();
  std::memcpy(sums_.data(), bytes.data() + sizeof header, sums_.size() * sizeof(int64_t));
  unit_ = header.unit;
  paths_ = header.paths;
  return true;
}

}  // namespace lampyris
