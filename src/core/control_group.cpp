// SPDX-License-Identifier: Apache-2.0
#include "core/control_group.h"

#include <algorithm>
#include <fstream>
#include <limits>
#include <optional>

namespace lampyris {

namespace {

struct Hierarchy {
  const char *folder, *limit, *used, *files;
};
constexpr Hierarchy kFirst{"/sys/fs/cgroup/memory", "/memory.limit_in_bytes",
                           "/memory.usage_in_bytes", "total_inactive_file"};
constexpr Hierarchy kSecond{"/sys/fs/cgroup", "/memory.max", "/memory.current", "inactive_file"};

/// None for "max", too.
std::optional<double> numberIn(const std::string& file) {
  std::ifstream in(file);
  double value = 0;
  return in >> value ? std::optional(value) : std::nullopt;
}

/// The value of `key` in lines of "key value".
double valueIn(const std::string& file, const std::string& key) {
  std::ifstream in(file);
  std::string name;
  double value = 0;
  while (in >> name >> value)
    if (name == key) return value;
  return 0;
}

double leftOf(const std::string& group, const Hierarchy& hierarchy) {
  const auto limit = numberIn(group + hierarchy.limit), used = numberIn(group + hierarchy.used);
  if (!limit || !used) return std::numeric_limits<double>::infinity();
  return std::max(0., *limit - *used + valueIn(group + "/memory.stat", hierarchy.files));
}

}  // namespace

double leftByControlGroup(const std::string& root) {
  std::ifstream in(root + "/proc/self/cgroup");
  std::string line;
  double left = std::numeric_limits<double>::infinity();
  while (std::getline(in, line)) {
    // "0::/path" of v2; "4:memory:/path" of v1, perhaps with further controllers.
    const size_t first = line.find(':'), path = line.find(":/");
    if (first == std::string::npos || path == std::string::npos) continue;
    const std::string controllers = "," + line.substr(first + 1, path - first - 1) + ",";
    const bool second = line.starts_with("0::");
    if (!second && controllers.find(",memory,") == std::string::npos) continue;
    const Hierarchy& hierarchy = second ? kSecond : kFirst;
    const std::string folder = root + hierarchy.folder;
    // In a container the path may be the host's: then the folder itself is the group.
    for (std::string group = line.substr(path + 1);; group.resize(group.rfind('/'))) {
      left = std::min(left, leftOf(folder + group, hierarchy));
      if (group.empty()) break;
    }
  }
  return left;
}

}  // namespace lampyris
