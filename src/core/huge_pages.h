// SPDX-License-Identifier: Apache-2.0
/// Memory in pages of 2 MiB, where the system offers them, for large arrays that are read at
/// random: with pages of 4 KiB finding a page takes as long as reading from it.
#pragma once

#include <sys/mman.h>

#include <algorithm>
#include <cstdlib>
#include <new>
#include <vector>

namespace lampyris {

inline constexpr size_t kHugePage = size_t{2} << 20;

/// Moves what this process has in memory by now, whoever allocated it, into such pages where it
/// fills one: the ray tracer's tree, meshes. Takes as long as copying it. Does nothing on Linux
/// before 6.1.
void gatherIntoHugePages();

/// An allocator for containers. Only a hint: without such pages it is memory like any other.
/// Elements that a container makes without a value are default-initialised: numbers are not set to
/// zero, so that the thread that fills them is the first to touch them.
template <class T>
struct HugePageAllocator {
  using value_type = T;

  HugePageAllocator() = default;
  template <class U>
  HugePageAllocator(const HugePageAllocator<U>&) {}
  bool operator==(const HugePageAllocator&) const { return true; }

  T* allocate(size_t count) {
    const size_t bytes = count * sizeof(T);
    const bool large = bytes >= 2 * kHugePage;
    const size_t alignment = large ? kHugePage : std::max(alignof(T), sizeof(void*));
    void* const p = std::aligned_alloc(alignment, (bytes + alignment - 1) / alignment * alignment);
    if (!p) throw std::bad_alloc();
    if (large) madvise(p, bytes, MADV_HUGEPAGE);
    return static_cast<T*>(p);
  }
  void deallocate(T* p, size_t) { std::free(p); }

  template <class U>
  void construct(U* p) {
    ::new (static_cast<void*>(p)) U;
  }
  template <class U, class... Args>
  void construct(U* p, Args&&... args) {
    ::new (static_cast<void*>(p)) U(std::forward<Args>(args)...);
  }
};

template <class T>
using HugeVector = std::vector<T, HugePageAllocator<T>>;

}  // namespace lampyris
