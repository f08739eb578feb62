// SPDX-License-Identifier: Apache-2.0
#include "core/huge_page_object.h"

#include <atomic>
#include <cassert>
#include <cstdint>
#include <cstdlib>
#include <new>

#include "core/huge_pages.h"

namespace lampyris {

namespace {

constexpr size_t kCacheLine = 64;
constexpr size_t kMostBytes = size_t{64} << 10;

/// Lies at the start of its page, which is aligned to its own size. Takes a whole cache line, so
/// that objects of half a line straddle none.
struct alignas(kCacheLine) Page {
  std::atomic<uint32_t> users{1};  ///< its objects, and the thread that fills it

  static Page* make() {
    void* const memory = std::aligned_alloc(kHugePage, kHugePage);
    if (!memory) throw std::bad_alloc();
    madvise(memory, kHugePage, MADV_HUGEPAGE);  // only a hint
    return ::new (memory) Page;
  }
  static Page* of(void* object) {
    return reinterpret_cast<Page*>(reinterpret_cast<uintptr_t>(object) & ~(kHugePage - 1));
  }
  void leave() {
    if (users.fetch_sub(1, std::memory_order_acq_rel) == 1) std::free(this);
  }
};

/// The page that a thread fills.
class Filler {
 public:
  ~Filler() {
    if (page_) page_->leave();
  }
  void* take(size_t bytes) {
    assert(bytes <= kMostBytes);
    const size_t size = (bytes + alignof(std::max_align_t) - 1) & ~(alignof(std::max_align_t) - 1);
    // No more cache lines than it must.
    if (used_ % kCacheLine + size > kCacheLine)
      used_ = (used_ + kCacheLine - 1) & ~(kCacheLine - 1);
    if (used_ + size > kHugePage) {
      Page* const next = Page::make();
      if (page_) page_->leave();
      page_ = next;
      used_ = sizeof(Page);
    }
    void* const object = reinterpret_cast<std::byte*>(page_) + used_;
    used_ += size;
    page_->users.fetch_add(1, std::memory_order_relaxed);
    return object;
  }

 private:
  Page* page_ = nullptr;
  size_t used_ = kHugePage;
};
thread_local Filler filler;

}  // namespace

void* HugePageObject::operator new(size_t bytes) { return filler.take(bytes); }

void HugePageObject::operator delete(void* p) noexcept {
  if (p) Page::of(p)->leave();
}

}  // namespace lampyris
