// SPDX-License-Identifier: Apache-2.0
/// How much memory and time a reader may take for an input.
#pragma once

#include <cstddef>

namespace lampyris::fuzz {

/// While it lives, the process aborts with a message where more than `bytes` are allocated at a
/// time beyond what was at its beginning, by all threads together; and in the end where the process
/// has computed for more than a second (which a busy machine does not lengthen).
class Bounds {
 public:
  explicit Bounds(size_t bytes);
  ~Bounds();
  Bounds(const Bounds&) = delete;
  Bounds& operator=(const Bounds&) = delete;

 private:
  double start_;
};

}  // namespace lampyris::fuzz
