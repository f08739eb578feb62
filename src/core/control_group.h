// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace lampyris {

/// Bytes that this process's control group, or one that it is in, leaves of its limit (cgroup v2,
/// or the memory controller of v1); infinite where there is none. Files that the kernel keeps in
/// memory until it is wanted are no use of it. `root`: where /proc and /sys are, for tests.
double leftByControlGroup(const std::string& root = "");

}  // namespace lampyris
