// SPDX-License-Identifier: Apache-2.0
/// Storage for many small lists that live together.
#pragma once

#include <sys/mman.h>

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <memory>
#include <new>
#include <span>
#include <type_traits>
#include <vector>

namespace lampyris {

/// Lists of T, each contiguous, written one after the other and never moved once taken. Memory
/// comes in chunks that grow, so that neither a list nor an element costs an allocation.
template <class T>
class Arena {
  static_assert(std::is_trivially_copyable_v<T> && std::is_trivially_destructible_v<T>);

 public:
  Arena() = default;
  Arena(Arena&& other) noexcept { swap(other); }
  Arena& operator=(Arena&& other) noexcept {
    swap(other);
    return *this;
  }
  Arena(const Arena&) = delete;
  Arena& operator=(const Arena&) = delete;

  /// Appends to the open list.
  void push(const T& v) {
    if (at_ == end_) grow();
    *at_++ = v;
  }
  /// The open list so far.
  std::span<T> open() { return {start_, at_}; }
  /// Shortens the open list to its first `count` elements.
  void truncate(size_t count) { at_ = start_ + count; }
  /// Closes the open list; it stays valid as long as the arena.
  std::span<const T> take() {
    const std::span<const T> list(start_, at_);
    start_ = at_;
    return list;
  }

 private:
  static constexpr size_t kFirstBytes = size_t{1} << 12, kLargestBytes = size_t{1} << 24;
  /// Large chunks are made of pages of this size: to fault in small ones takes as long as to parse.
  static constexpr size_t kHugePage = size_t{1} << 21;

  struct Free {
    size_t alignment;
    void operator()(std::byte* p) const { ::operator delete(p, std::align_val_t(alignment)); }
  };

  void grow() {
    const size_t open = static_cast<size_t>(at_ - start_);
    const bool isLarge = nextBytes_ >= kHugePage || 2 * open * sizeof(T) >= kHugePage;
    const size_t unit = isLarge ? kHugePage : kFirstBytes;
    const size_t bytes = (std::max(nextBytes_, 2 * open * sizeof(T)) + unit - 1) / unit * unit;
    nextBytes_ = std::min(2 * nextBytes_, kLargestBytes);
    const size_t alignment = isLarge ? kHugePage : alignof(std::max_align_t);
    chunks_.emplace_back(
        static_cast<std::byte*>(::operator new(bytes, std::align_val_t(alignment))),
        Free{alignment});
    std::byte* const chunk = chunks_.back().get();
    if (isLarge) ::madvise(chunk, bytes, MADV_HUGEPAGE);
    if (open) std::memcpy(chunk, start_, open * sizeof(T));
    start_ = reinterpret_cast<T*>(chunk);
    at_ = start_ + open;
    end_ = start_ + bytes / sizeof(T);
  }

  void swap(Arena& other) {
    std::swap(chunks_, other.chunks_);
    std::swap(start_, other.start_);
    std::swap(at_, other.at_);
    std::swap(end_, other.end_);
    std::swap(nextBytes_, other.nextBytes_);
  }

  std::vector<std::unique_ptr<std::byte[], Free>> chunks_;
  T* start_ = nullptr;
  T* at_ = nullptr;
  T* end_ = nullptr;
  size_t nextBytes_ = kFirstBytes;
};

}  // namespace lampyris
