// SPDX-License-Identifier: Apache-2.0
#include "core/huge_pages.h"

#include <gtest/gtest.h>

#include <fstream>
#include <string>

namespace lampyris {
namespace {

constexpr size_t kBytes = 8 * kHugePage;

/// Of the mapping that starts at `p`, in bytes; negative if it is not found.
double ofMapping(const char* p, const std::string& what) {
  std::ifstream maps("/proc/self/smaps");
  const auto address = reinterpret_cast<uintptr_t>(p);
  bool within = false;
  for (std::string line; std::getline(maps, line);) {
    const size_t dash = line.find('-');
    if (dash < line.find(' ') && dash < line.find(':')) {
      within = std::stoull(line, nullptr, 16) <= address &&
               address < std::stoull(line.substr(dash + 1), nullptr, 16);
    } else if (within && line.starts_with(what + ":")) {
      return 1024 * std::stod(line.substr(what.size() + 1));
    }
  }
  return -1;
}

/// Memory of its own mapping, in small pages.
struct Mapping {
  // Between pages without access, so that nothing is joined to it.
  char* const whole = static_cast<char*>(
      mmap(nullptr, kBytes + 2 * kHugePage, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0));
  char* const begin = whole + kHugePage;
  Mapping() { mprotect(begin, kBytes, PROT_READ | PROT_WRITE); }
  ~Mapping() { munmap(whole, kBytes + 2 * kHugePage); }
  Mapping(const Mapping&) = delete;
  Mapping& operator=(const Mapping&) = delete;
};

TEST(HugePages, GatherWhatIsInUse) {
  const Mapping m;
  for (size_t i = 0; i < kBytes; ++i) m.begin[i] = static_cast<char>(i % 251);
  gatherIntoHugePages();
  size_t wrong = 0;
  for (size_t i = 0; i < kBytes; ++i) wrong += m.begin[i] != static_cast<char>(i % 251);
  EXPECT_EQ(wrong, 0u);
  const double huge = ofMapping(m.begin, "AnonHugePages");
  if (!(huge > 0)) GTEST_SKIP() << "this system has no such pages, or cannot gather them";
  EXPECT_GE(huge, static_cast<double>(kBytes - kHugePage));
}

TEST(HugePages, DoNotTakeMemoryThatIsNotInUse) {
  const Mapping m;
  for (size_t i = 0; i < kBytes; i += 2 * 4096) m.begin[i] = 1;  // every other page
  const double before = ofMapping(m.begin, "Rss");
  gatherIntoHugePages();
  EXPECT_EQ(ofMapping(m.begin, "Rss"), before);
}

}  // namespace
}  // namespace lampyris
