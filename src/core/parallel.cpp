// SPDX-License-Identifier: Apache-2.0
#include "core/parallel.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/parallel_invoke.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>
#include <cstdint>

#include "core/hand_over.h"

namespace lampyris {

namespace tbb = oneapi::tbb;

struct ThreadLimit::Impl {
  explicit Impl(size_t n) : control(tbb::global_control::max_allowed_parallelism, n) {}
  tbb::global_control control;
};

ThreadLimit::ThreadLimit(int threads)
    : impl_(std::make_unique<Impl>(
          static_cast<size_t>(threads > 0 ? threads : tbb::info::default_concurrency()))) {}
ThreadLimit::~ThreadLimit() = default;

int threadCount() {
  const auto allowed = static_cast<int>(
      tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
  return std::max(allowed, 1);
}

void parallelFor(size_t count, size_t grain, const std::function<void(size_t, size_t)>& body) {
  // TBB halves what is larger than its grain size: at 2 grain − 1, halves have at least `grain`.
  const size_t largest = 2 * std::clamp<size_t>(grain, 1, SIZE_MAX / 2) - 1;
  // Isolated: while it waits, a thread that holds a lock must take nothing of an outer loop, which
  // may want the same lock.
  const HandOver begun, done;
  begun.give();
  tbb::this_task_arena::isolate([&] {
    tbb::parallel_for(tbb::blocked_range<size_t>(0, count, largest),
                      [&](const tbb::blocked_range<size_t>& r) {
                        begun.take();
                        body(r.begin(), r.end());
                        done.give();
                      });
  });
  done.take();
}

void parallelInvoke(const std::function<void()>& a, const std::function<void()>& b) {
  const HandOver begun, done;
  begun.give();
  const auto run = [&](const std::function<void()>& f) {
    begun.take();
    f();
    done.give();
  };
  tbb::parallel_invoke([&] { run(a); }, [&] { run(b); });
  done.take();
}

}  // namespace lampyris
