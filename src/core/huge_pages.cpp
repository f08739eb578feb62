// SPDX-License-Identifier: Apache-2.0
#include "core/huge_pages.h"

#include <unistd.h>

#include <array>
#include <cstdint>
#include <fstream>
#include <sstream>
#include <string>

#include "core/memory.h"

namespace lampyris {

namespace {

constexpr int kCollapse = 25;  // MADV_COLLAPSE of Linux 6.1, which older headers lack

/// Whether all small pages of the large one are there: what was never used stays that way.
bool isResident(char* page) {
  std::array<unsigned char, kHugePage / 4096> there;
  const auto size = static_cast<size_t>(sysconf(_SC_PAGESIZE));
  if (size < 4096 || mincore(page, kHugePage, there.data()) != 0) return false;
  return std::all_of(there.begin(), there.begin() + static_cast<ptrdiff_t>(kHugePage / size),
                     [](unsigned char c) { return c & 1; });
}

}  // namespace

void gatherIntoHugePages() {
  // Larger mappings are reserved rather than used, such as those of sanitizers.
  const double most = 64 * usedMemory();
  std::ifstream maps("/proc/self/maps");
  for (std::string line; std::getline(maps, line);) {
    std::istringstream fields(line);
    std::string range, access, offset, device, path;
    uint64_t inode = 0;
    if (!(fields >> range >> access >> offset >> device >> inode)) continue;
    fields >> path;
    if (access != "rw-p" || inode != 0 || !(path.empty() || path == "[heap]")) continue;
    uintptr_t begin = std::stoull(range, nullptr, 16);
    const uintptr_t end = std::stoull(range.substr(range.find('-') + 1), nullptr, 16);
    if (static_cast<double>(end - begin) > most) continue;
    begin = (begin + kHugePage - 1) & ~(kHugePage - 1);
    for (; begin + kHugePage <= end; begin += kHugePage) {
      auto* const page = reinterpret_cast<char*>(begin);
      if (isResident(page)) madvise(page, kHugePage, kCollapse);
    }
  }
}

}  // namespace lampyris
