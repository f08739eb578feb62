// SPDX-License-Identifier: Apache-2.0
#include "core/memory.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <limits>

namespace lampyris {

namespace {

std::atomic<double> limit{std::numeric_limits<double>::infinity()};

}  // namespace

double availableMemory() {
  double bytes = limit;
  const auto pages = static_cast<double>(::sysconf(_SC_PHYS_PAGES));
  if (pages > 0) bytes = std::min(bytes, pages * static_cast<double>(::sysconf(_SC_PAGESIZE)));
  rlimit address{};
  if (::getrlimit(RLIMIT_AS, &address) == 0 && address.rlim_cur != RLIM_INFINITY)
    bytes = std::min(bytes, static_cast<double>(address.rlim_cur));
  return bytes;
}

void limitMemory(double bytes) { limit = bytes; }

}  // namespace lampyris
