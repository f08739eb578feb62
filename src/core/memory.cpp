// SPDX-License-Identifier: Apache-2.0
#include "core/memory.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <atomic>
#include <fstream>
#include <limits>
#include <optional>

#include "core/control_group.h"
#include "core/error.h"

namespace lampyris {

namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();
std::atomic<double> ownLimit{kInfinite};

/// The number behind `key` in lines of "key: number kB", in bytes.
std::optional<double> kilobytesOf(const char* file, const std::string& key) {
  std::ifstream in(file);
  std::string line;
  while (std::getline(in, line))
    if (line.starts_with(key)) return 1024 * std::strtod(line.c_str() + key.size(), nullptr);
  return std::nullopt;
}

double leftByAddressSpace() {
  rlimit address{};
  if (::getrlimit(RLIMIT_AS, &address) != 0 || address.rlim_cur == RLIM_INFINITY) return kInfinite;
  const double used = kilobytesOf("/proc/self/status", "VmSize:").value_or(0);
  return std::max(0., static_cast<double>(address.rlim_cur) - used);
}

}  // namespace

MemoryLimit memoryLimit() {
  MemoryLimit least{kilobytesOf("/proc/meminfo", "MemAvailable:").value_or(kInfinite),
                    "available memory"};
  const auto atMost = [&least](double bytes, const char* name) {
    if (bytes < least.bytes) least = {bytes, name};
  };
  atMost(leftByControlGroup(), "control group");
  atMost(leftByAddressSpace(), "ulimit -v");
  atMost(ownLimit, "memory limit");
  return least;
}

void limitMemory(double bytes) { ownLimit = bytes; }

double usedMemory() { return kilobytesOf("/proc/self/status", "VmRSS:").value_or(0); }
double peakMemory() { return kilobytesOf("/proc/self/status", "VmHWM:").value_or(0); }

std::string memoryText(double bytes) {
  constexpr double kMiB = 0x1p20, kGiB = 0x1p30;
  return bytes < kGiB ? fmt::format("{:.0f} MiB", bytes / kMiB)
                      : fmt::format("{:.1f} GiB", bytes / kGiB);
}

void expectMemory(double bytes, const std::string& what, SourceLocation where) {
  const MemoryLimit limit = memoryLimit();
  if (bytes <= limit.bytes) return;
  throw SceneError(where, fmt::format("{} needs about {} of memory; the limit is {} ({})", what,
                                      memoryText(bytes), memoryText(limit.bytes), limit.name));
}

}  // namespace lampyris
