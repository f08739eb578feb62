// SPDX-License-Identifier: Apache-2.0
/// Values of a PLY file's data, one after the other.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>
#include <string_view>

#include "shapes/ply_header.h"

namespace lampyris {

/// One value at `from`; `swap` if its byte order is not this machine's.
template <class T>
T plyLoad(const char* from, bool swap) {
  std::array<char, sizeof(T)> bytes;
  std::memcpy(bytes.data(), from, sizeof(T));
  if (swap) std::reverse(bytes.begin(), bytes.end());
  return std::bit_cast<T>(bytes);
}

/// Calls f with a value of the C++ type that stands for `type`.
template <class F>
decltype(auto) plyDispatch(PlyType type, F&& f) {
  switch (type) {
    case PlyType::Int8:
      return f(int8_t{});
    case PlyType::Uint8:
      return f(uint8_t{});
    case PlyType::Int16:
      return f(int16_t{});
    case PlyType::Uint16:
      return f(uint16_t{});
    case PlyType::Int32:
      return f(int32_t{});
    case PlyType::Uint32:
      return f(uint32_t{});
    case PlyType::Float32:
      return f(float{});
    case PlyType::Float64:
      break;
  }
  return f(double{});
}

/// A cursor over the data; throws std::runtime_error at its end.
class PlyReader {
 public:
  PlyReader(std::string_view data, PlyFormat format)
      : at_(data.data()),
        end_(data.data() + data.size()),
        ascii_(format == PlyFormat::Ascii),
        swap_((format == PlyFormat::BigEndian) == (std::endian::native == std::endian::little)) {}

  bool ascii() const { return ascii_; }
  bool swap() const { return swap_; }
  const char* position() const { return at_; }
  uint64_t remaining() const { return static_cast<uint64_t>(end_ - at_); }
  /// The least number of bytes that `values` of a type take.
  uint64_t leastSize(PlyType type) const { return ascii_ ? 2 : plySize(type); }

  /// Every PLY type fits into a double exactly.
  double next(PlyType type) {
    if (ascii_) return nextToken();
    const size_t size = plySize(type);
    if (remaining() < size) endOfData();
    const double v =
        plyDispatch(type, [&]<class T>(T) { return static_cast<double>(plyLoad<T>(at_, swap_)); });
    at_ += size;
    return v;
  }
  /// The length of a list whose values are in the file.
  size_t nextCount(const PlyProperty& list) {
    const double n = next(list.countType);
    if (!(n >= 0) || n != std::floor(n)) throw std::runtime_error("a list has a negative length");
    // In ASCII the last value needs no blank after it.
    if (n * static_cast<double>(leastSize(list.type)) > static_cast<double>(remaining()) + 1)
      endOfData();
    return static_cast<size_t>(n);
  }
  void skip(uint64_t bytes) {
    if (remaining() < bytes) endOfData();
    at_ += bytes;
  }
  void skipValues(PlyType type, size_t count) {
    if (!ascii_) return skip(count * plySize(type));
    for (size_t i = 0; i < count; ++i) nextToken();
  }
  [[noreturn]] static void endOfData() {
    throw std::runtime_error("it ends before the data that its header announces; it is truncated");
  }

 private:
  double nextToken() {
    while (at_ != end_ && (*at_ == ' ' || (*at_ >= '\t' && *at_ <= '\r'))) ++at_;
    if (at_ == end_) endOfData();
    const char* begin = *at_ == '+' ? at_ + 1 : at_;
    double v = 0;
    const auto [stop, error] = std::from_chars(begin, end_, v);
    const bool ends = stop == end_ || *stop == ' ' || (*stop >= '\t' && *stop <= '\r');
    if (error == std::errc::invalid_argument || !ends)
      throw std::runtime_error(
          "expected a number, got \"" +
          std::string(at_, static_cast<size_t>(std::min<std::ptrdiff_t>(end_ - at_, 20))) + "\"");
    if (error == std::errc::result_out_of_range) {
      const bool tiny = std::string_view(begin, static_cast<size_t>(stop - begin)).find('-', 1) !=
                        std::string_view::npos;
      v = tiny ? 0 : std::numeric_limits<double>::infinity();
    }
    at_ = stop;
    return v;
  }

  const char* at_;
  const char* end_;
  bool ascii_, swap_;
};

}  // namespace lampyris
