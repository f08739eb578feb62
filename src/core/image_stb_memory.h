// SPDX-License-Identifier: Apache-2.0
/// What stb allocates while it reads an image.
#pragma once

#include <cstddef>
#include <vector>

namespace lampyris {

/// While it lives, stb's readers allocate from it on this thread, and only then may they be called.
/// Its end frees what they did not, so that an exception may leave them. What they get is zero, so
/// that a damaged file gives the same pixels every time.
class StbMemory {
 public:
  /// stb is refused more than `limit` bytes at a time: it takes a file's word for what it
  /// allocates.
  explicit StbMemory(size_t limit);
  ~StbMemory();
  StbMemory(const StbMemory&) = delete;
  StbMemory& operator=(const StbMemory&) = delete;

  void setLimit(size_t limit) { limit_ = limit; }
  bool wasRefused() const { return refused_; }

  // What stb calls.
  static void* allocate(size_t bytes) { return reallocate(nullptr, bytes); }
  static void* reallocate(void* old, size_t bytes);
  static void release(void* memory);

 private:
  struct Block {
    void* memory;
    size_t bytes;
  };
  Block* find(const void* memory);

  std::vector<Block> blocks_;
  size_t used_ = 0, limit_;
  bool refused_ = false;
};

}  // namespace lampyris
