// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace lampyris {

/// Fetches the cache line of `p` while the program goes on. GCC takes a function that does nothing
/// but __builtin_prefetch for one without effect and drops calls of it; the empty statement is one.
inline void prefetchLine(const void* p) {
  __builtin_prefetch(p);
  asm volatile("" : : "r"(p));
}

}  // namespace lampyris
