// SPDX-License-Identifier: Apache-2.0
#include "bounds.h"

#include <sanitizer/allocator_interface.h>
#include <sanitizer/common_interface_defs.h>
#include <sys/time.h>

#include <atomic>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>

namespace lampyris::fuzz {

namespace {

constexpr int64_t kUnlimited = INT64_MAX / 2;
std::atomic<int64_t> left{kUnlimited};

void onAllocation(const volatile void*, size_t size) {
  const auto bytes = static_cast<int64_t>(size);
  if (left.fetch_sub(bytes, std::memory_order_relaxed) >= bytes) return;
  left = kUnlimited;  // for what follows here
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

// One timer for all inputs: a system call for each would cost more than most of them.
constexpr int kTicksPerSecond = 10;
constexpr int kIdle = -1;
std::atomic<int> ticks{kIdle};  ///< since the input began

void onTick(int) {
  if (ticks.load() == kIdle || ticks.fetch_add(1) < kTicksPerSecond) return;
  std::fprintf(stderr, "this input takes more than a second\n");
  __sanitizer_print_stack_trace();
  std::abort();
}

bool install() {
  struct sigaction action {};
  action.sa_handler = onTick;
  action.sa_flags = SA_RESTART;
  const timeval tick{0, 1'000'000 / kTicksPerSecond};
  const itimerval timer{tick, tick};
  return __sanitizer_install_malloc_and_free_hooks(onAllocation, onRelease) != 0 &&
         ::sigaction(SIGPROF, &action, nullptr) == 0 &&
         ::setitimer(ITIMER_PROF, &timer, nullptr) == 0;
}

}  // namespace

Bounds::Bounds(size_t bytes) {
  static const bool installed = install();
  if (!installed) std::abort();
  ticks = 0;
  left = static_cast<int64_t>(bytes);
}

Bounds::~Bounds() {
  left = kUnlimited;
  ticks = kIdle;
}

}  // namespace lampyris::fuzz
