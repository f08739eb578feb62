// SPDX-License-Identifier: Apache-2.0
/// Parallel loops on oneTBB. What a loop computes must not depend on how it is split.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>

namespace lampyris {

/// Limits all parallel loops to `threads` (0: one per hardware thread) while it lives.
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads);
  ~ThreadLimit();
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// The number of threads that parallel loops use now.
int threadCount();

/// body(begin, end) over [0, count) in pieces of at least `grain` items, in parallel. An exception
/// of a body is rethrown here.
void parallelFor(size_t count, size_t grain, const std::function<void(size_t, size_t)>& body);

/// Runs both, in parallel where a thread is free.
void parallelInvoke(const std::function<void()>& a, const std::function<void()>& b);

}  // namespace lampyris
