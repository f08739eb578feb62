// SPDX-License-Identifier: Apache-2.0
#include "core/memory.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <atomic>
#include <fstream>
#include <limits>
#include <optional>

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

std::optional<double> numberIn(const std::string& file) {
  std::ifstream in(file);
  double value = 0;
  return in >> value ? std::optional(value) : std::nullopt;
}

/// What the control group, or one that it is in, leaves (cgroup v2; v1 names its files otherwise).
double leftByControlGroup() {
  std::ifstream in("/proc/self/cgroup");
  std::string line;
  double left = kInfinite;
  const auto look = [&](const std::string& folder, const char* most, const char* now) {
    const auto limit = numberIn(folder + most), used = numberIn(folder + now);
    if (limit && used) left = std::min(left, std::max(0., *limit - *used));
  };
  while (std::getline(in, line)) {
    const size_t path = line.find('/');
    if (path == std::string::npos) continue;
    const bool second = line.starts_with("0::");
    if (!second && line.find(":memory:") == std::string::npos) continue;
    const std::string root = second ? "/sys/fs/cgroup" : "/sys/fs/cgroup/memory";
    for (std::string group = line.substr(path);; group.resize(group.rfind('/'))) {
      if (second)
        look(root + group, "/memory.max", "/memory.current");
      else
        look(root + group, "/memory.limit_in_bytes", "/memory.usage_in_bytes");
      if (group.empty()) break;
    }
  }
  return left;
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
