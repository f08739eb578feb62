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
  uint32_t version = 4;
  uint32_t pixelBytes = sizeof(PixelSums);
  std::array<int32_t, 2> resolution{};
  std::array<int32_t, 4> bounds{};
  uint64_t aovs = 0;
  double scale = 0;
  uint64_t tail = 0;

  bool operator==(const Header&) const = default;
};

Header headerOf(const FilmFrame& f, size_t tail) {
  Header h;
  h.resolution = {f.resolution.x, f.resolution.y};
  h.bounds = {f.bounds.min.x, f.bounds.min.y, f.bounds.max.x, f.bounds.max.y};
  h.aovs = f.aovs.bits();
  h.scale = f.scale;
  h.tail = tail;
  return h;
}

Header readHeader(std::string_view bytes) {
  Header header;
  std::memcpy(&header, bytes.data(), sizeof header);
  return header;
}

}  // namespace

uint64_t checksum(const char* bytes, size_t size) {
  uint64_t h = size;
  for (size_t i = 0; i < size; i += sizeof(uint64_t)) {
    uint64_t word = 0;
    std::memcpy(&word, bytes + i, sizeof word);
    h = mixBits(h * 0x9e3779b97f4a7c15ULL + word);
  }
  return h;
}

std::string encodeSums(const FilmFrame& frame, std::span<const PixelSums> sums,
                       std::span<const WideSum> aovSums, size_t tail) {
  const Header header = headerOf(frame, tail);
  std::string bytes;
  bytes.reserve(sizeof header + sums.size_bytes() + aovSums.size_bytes() + sizeof(uint64_t));
  bytes.append(reinterpret_cast<const char*>(&header), sizeof header);
  bytes.append(reinterpret_cast<const char*>(sums.data()), sums.size_bytes());
  if (!aovSums.empty())
    bytes.append(reinterpret_cast<const char*>(aovSums.data()), aovSums.size_bytes());
  const uint64_t sum = checksum(bytes.data(), bytes.size());
  bytes.append(reinterpret_cast<const char*>(&sum), sizeof sum);
  return bytes;
}

std::optional<FilmFrame> frameOfSums(std::string_view bytes) {
  if (bytes.size() < sizeof(Header)) return std::nullopt;
  const Header h = readHeader(bytes);
  const Int2 min(h.bounds[0], h.bounds[1]), max(h.bounds[2], h.bounds[3]);
  return FilmFrame{{h.resolution[0], h.resolution[1]},
                   {min, max},
                   AovSet(static_cast<uint32_t>(h.aovs)),
                   h.scale};
}

bool decodeSums(std::string_view bytes, const FilmFrame& frame, std::span<PixelSums> sums,
                std::span<WideSum> aovSums, size_t tail) {
  if (bytes.size() < sizeof(Header) + sizeof(uint64_t)) return false;
  const size_t body = bytes.size() - sizeof(uint64_t);
  if (body - sizeof(Header) != sums.size_bytes() + aovSums.size_bytes()) return false;
  uint64_t sum = 0;
  std::memcpy(&sum, bytes.data() + body, sizeof sum);
  if (readHeader(bytes) != headerOf(frame, tail) || sum != checksum(bytes.data(), body))
    return false;
  const char* const data = bytes.data() + sizeof(Header);
  std::memcpy(sums.data(), data, sums.size_bytes());
  if (!aovSums.empty()) std::memcpy(aovSums.data(), data + sums.size_bytes(), aovSums.size_bytes());
  return true;
}

}  // namespace lampyris
