// SPDX-License-Identifier: Apache-2.0
/// Values as bytes of this machine, for checkpoints.
#pragma once

#include <array>
#include <bit>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace lampyris {

class ByteWriter {
 public:
  template <class T>
  void put(const T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
  }
  template <class T>
  void put(const std::vector<T>& values) {
    static_assert(std::is_trivially_copyable_v<T>);
    put(values.size());
    bytes_.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
  }
  const std::string& bytes() const { return bytes_; }

 private:
  std::string bytes_;
};

/// Reads what a ByteWriter has written. Beyond the end everything is zero, and ok() false.
class ByteReader {
 public:
  explicit ByteReader(std::string_view bytes) : left_(bytes) {}

  template <class T>
  void get(T& value) {
    static_assert(std::is_trivially_copyable_v<T>);
    value = T();
    take(&value, sizeof value);
  }
  template <class T>
  void get(std::vector<T>& values) {
    values.clear();
    const size_t count = getCount(sizeof(T));
    for (size_t i = 0; i < count; ++i) {
      std::array<char, sizeof(T)> raw{};
      take(raw.data(), raw.size());
      values.push_back(std::bit_cast<T>(raw));
    }
  }
  /// A number of things of at least so many bytes each; 0 where there is no room for them.
  size_t getCount(size_t bytesEach) {
    size_t count = 0;
    get(count);
    if (count <= left_.size() / bytesEach) return count;
    ok_ = false;
    return 0;
  }
  bool ok() const { return ok_; }
  bool atEnd() const { return left_.empty(); }

 private:
  void take(void* to, size_t size) {
    if (left_.size() < size) {
      ok_ = false;
      left_ = {};
      return;
    }
    std::memcpy(to, left_.data(), size);
    left_.remove_prefix(size);
  }

  std::string_view left_;
  bool ok_ = true;
};

}  // namespace lampyris
