// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <atomic>

namespace lampyris {

/// As long as one lives, the first SIGINT or SIGTERM sets flag() and the second ends the program at
/// once; otherwise the first does. One at a time.
class InterruptGuard {
 public:
  InterruptGuard();
  ~InterruptGuard();
  InterruptGuard(const InterruptGuard&) = delete;
  InterruptGuard& operator=(const InterruptGuard&) = delete;

  const std::atomic<bool>& flag() const;
};

/// From here on a file that grows beyond a limit and a reader that has gone are errors of writing
/// like any other.
void ignoreWriteSignals();

}  // namespace lampyris
