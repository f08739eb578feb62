// SPDX-License-Identifier: Apache-2.0
/// How much memory and time a reader may take for an input.
#pragma once

#include <cstddef>

namespace lampyris::fuzz {

/// While it lives, the process aborts with a stack trace where more than `bytes` are allocated at a
/// time beyond what was at its beginning, by all threads together; and where the process computes
/// for longer than a second: processor time, which a busy machine does not lengthen.
class Bounds {
 public:
  explicit Bounds(size_t bytes);
  ~Bounds();
  Bounds(const Bounds&) = delete;
  Bounds& operator=(const Bounds&) = delete;
};

}  // namespace lampyris::fuzz
