// SPDX-License-Identifier: Apache-2.0
#include "film/pixel_sums.h"

#include <array>
#include <bit>
#include <cstring>

#include "core/hash.h"

namespace lampyris {

namespace {

static_assert(std::endian::native == std::endian::little);

struct Header {
  std::array<char, 8> magic{'L', 'A', 'M', 'P', 'F', 'I', 'L', 'M'};
  uint32_t version = 1;
  uint32_t pixelBytes = sizeof(PixelSums);
  std::array<int32_t, 4> bounds{};

  bool operator==(const Header&) const = default;
};

Header headerOf(const PixelBounds& b) {
  Header h;
  h.bounds = {b.min.x, b.min.y, b.max.x, b.max.y};
  return h;
}

/// Depends on every bit and on the order; `bytes` is a multiple of 8 long.
uint64_t checksum(const char* bytes, size_t size) {
  uint64_t h = size;
  for (size_t i = 0; i < size; i += sizeof(uint64_t)) {
    uint64_t word = 0;
    std::memcpy(&word, bytes + i, sizeof word);
    h = mixBits(h * 0x9e3779b97f4a7c15ULL + word);
  }
  return h;
}

}  // namespace

std::string encodeSums(const PixelBounds& bounds, std::span<const PixelSums> sums) {
  const Header header = headerOf(bounds);
  std::string bytes;
  bytes.reserve(sizeof header + sums.size_bytes() + sizeof(uint64_t));
  bytes.append(reinterpret_cast<const char*>(&header), sizeof header);
  bytes.append(reinterpret_cast<const char*>(sums.data()), sums.size_bytes());
  const uint64_t sum = checksum(bytes.data(), bytes.size());
  bytes.append(reinterpret_cast<const char*>(&sum), sizeof sum);
  return bytes;
}

bool decodeSums(std::string_view bytes, const PixelBounds& bounds, std::span<PixelSums> out) {
  if (bytes.size() < sizeof(Header) + sizeof(uint64_t)) return false;
  const size_t body = bytes.size() - sizeof(uint64_t);
  if (body - sizeof(Header) != out.size_bytes()) return false;
  Header header;
  std::memcpy(&header, bytes.data(), sizeof header);
  uint64_t sum = 0;
  std::memcpy(&sum, bytes.data() + body, sizeof sum);
  if (header != headerOf(bounds) || sum != checksum(bytes.data(), body)) return false;
  std::memcpy(out.data(), bytes.data() + sizeof header, body - sizeof header);
  return true;
}

}  // namespace lampyris
