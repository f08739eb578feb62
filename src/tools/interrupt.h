// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>

namespace lampyris {

/// From the first call on SIGINT and SIGTERM set the flag that is returned; a second signal ends
/// the program at once.
const std::atomic<bool>& interruptFlag();

}  // namespace lampyris
