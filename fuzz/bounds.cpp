// SPDX-License-Identifier: Apache-2.0
#include "bounds.h"

#include <sanitizer/allocator_interface.h>
#include <sanitizer/common_interface_defs.h>

#include <atomic>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>

namespace lampyris::fuzz {

namespace {

std::atomic<int64_t> left{INT64_MAX / 2};

void onAllocation(const volatile void*, size_t size) {
  const auto bytes = static_cast<int64_t>(size);
  if (left.fetch_sub(bytes, std::memory_order_relaxed) >= bytes) return;
  left = INT64_MAX / 2;  // for what follows here
  std::fprintf(stderr, "more memory than the bound for this input: the last piece has %zu bytes\n",
               size);
  __sanitizer_print_stack_trace();
  std::abort();
}

void onRelease(const volatile void* memory) {
  if (!memory) return;
  left.fetch_add(
      static_cast<int64_t>(__sanitizer_get_allocated_size(const_cast<const void*>(memory))),
      std::memory_order_relaxed);
}

double cpuSeconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

}  // namespace

Bounds::Bounds(size_t bytes) : start_(cpuSeconds()) {
  static const int installed = __sanitizer_install_malloc_and_free_hooks(onAllocation, onRelease);
  if (installed == 0) std::abort();
  left = static_cast<int64_t>(bytes);
}

Bounds::~Bounds() {
  left = INT64_MAX / 2;
  constexpr double kLongest = 1;
  if (const double seconds = cpuSeconds() - start_; seconds > kLongest) {
    std::fprintf(stderr, "this input takes %.2f seconds\n", seconds);
    std::abort();
  }
}

}  // namespace lampyris::fuzz
