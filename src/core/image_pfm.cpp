// SPDX-License-Identifier: Apache-2.0
// Portable float maps: "PF" or "Pf", width, height, a scale whose sign tells the byte order
// (negative: little endian), then floats row by row from the bottom (Debevec's PFM).
#include <fmt/format.h>

#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>

#include "core/atomic_file.h"
#include "core/image_formats.h"

namespace lampyris {

namespace {

bool isSpace(char c) { return c == ' ' || c == '\n' || c == '\r' || c == '\t'; }

/// The next word of the header; exactly one blank after it is consumed.
std::string_view nextWord(std::string_view& rest) {
  size_t begin = 0;
  while (begin < rest.size() && isSpace(rest[begin])) ++begin;
  size_t end = begin;
  while (end < rest.size() && !isSpace(rest[end])) ++end;
  const std::string_view word = rest.substr(begin, end - begin);
  rest.remove_prefix(std::min(end + 1, rest.size()));
  return word;
}

template <class T>
T number(const std::string& path, std::string_view word) {
  T v{};
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), v);
  if (error != std::errc() || end != word.data() + word.size())
    failImageRead(path, "expected the header of a PFM file: PF or Pf, width, height, scale");
  return v;
}

float swapBytes(float v) {
  return std::bit_cast<float>(__builtin_bswap32(std::bit_cast<uint32_t>(v)));
}

}  // namespace

LoadedImage readPfmImage(const std::string& path, std::string_view bytes) {
  const std::string_view magic = nextWord(bytes);
  if (magic != "PF" && magic != "Pf") failImageRead(path, "a PFM file starts with PF or Pf");
  const int channels = magic == "PF" ? 3 : 1;
  const int width = number<int>(path, nextWord(bytes));
  const int height = number<int>(path, nextWord(bytes));
  const float scale = number<float>(path, nextWord(bytes));
  checkImageSize(path, width, height);
  if (!std::isfinite(scale) || scale == 0) failImageRead(path, "its scale is 0 or not finite");

  const size_t rowBytes =
      static_cast<size_t>(width) * static_cast<size_t>(channels) * sizeof(float);
  if (bytes.size() < rowBytes * static_cast<size_t>(height))
    failImageRead(path, fmt::format("the file is truncated: {} bytes of pixels, expected {}",
                                    bytes.size(), rowBytes * static_cast<size_t>(height)));
  Image image(width, height, channels);
  for (int y = 0; y < height; ++y)
    std::memcpy(&image.at(0, height - 1 - y, 0), bytes.data() + static_cast<size_t>(y) * rowBytes,
                rowBytes);
  const bool swap = (scale < 0) != (std::endian::native == std::endian::little);
  const float factor = std::abs(scale);
  if (swap)
    for (float& v : image.data()) v = swapBytes(v);
  if (factor != 1)
    for (float& v : image.data()) v *= factor;
  return {std::move(image), false};
}

void writePfmImage(const std::string& path, const Image& image) {
  const int stored = image.channels() >= 3 ? 3 : 1;
  const float scale = std::endian::native == std::endian::little ? -1.f : 1.f;
  AtomicFile file(path);
  const std::string header = fmt::format("{}\n{} {}\n{:.1f}\n", stored == 3 ? "PF" : "Pf",
                                         image.width(), image.height(), scale);
  file.write(header.data(), header.size());
  std::vector<float> row(static_cast<size_t>(image.width()) * static_cast<size_t>(stored));
  for (int y = image.height() - 1; y >= 0; --y) {
    size_t i = 0;
    for (int x = 0; x < image.width(); ++x)
      for (int c = 0; c < stored; ++c) row[i++] = image.at(x, y, c);
    file.write(row.data(), row.size() * sizeof(float));
  }
  file.commit();
}

}  // namespace lampyris
