// SPDX-License-Identifier: Apache-2.0
#include "core/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <mutex>
#include <set>
#include <stdexcept>
#include <thread>
#include <vector>

#include "core/statistics.h"

namespace lampyris {
namespace {

TEST(ParallelFor, VisitsEveryItemOnce) {
  for (const size_t count : {size_t{0}, size_t{1}, size_t{7}, size_t{100'000}})
    for (const size_t grain : {size_t{0}, size_t{1}, size_t{64}, SIZE_MAX}) {
      std::vector<int> visits(count);
      parallelFor(count, grain, [&](size_t begin, size_t end) {
        for (size_t i = begin; i < end; ++i) ++visits[i];
      });
      EXPECT_EQ(visits, std::vector<int>(count, 1)) << count << " " << grain;
    }
}

TEST(ParallelFor, PiecesAreNotSmallerThanTheGrain) {
  std::atomic<size_t> smallest{SIZE_MAX};
  parallelFor(1000, 100, [&](size_t begin, size_t end) {
    size_t now = smallest;
    while (end - begin < now && !smallest.compare_exchange_weak(now, end - begin)) {
    }
  });
  EXPECT_GE(smallest, 100u);
}

TEST(ParallelFor, ExceptionsArrive) {
  EXPECT_THROW(parallelFor(1000, 1,
                           [](size_t begin, size_t end) {
                             if (begin <= 500 && 500 < end) throw std::runtime_error("x");
                           }),
               std::runtime_error);
  // And leave the loops usable.
  std::atomic<size_t> sum{0};
  parallelFor(10, 1, [&](size_t begin, size_t end) { sum += end - begin; });
  EXPECT_EQ(sum, 10u);
}

TEST(ParallelFor, Nests) {
  std::atomic<int> sum{0};
  parallelFor(20, 1, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i)
      parallelFor(50, 1, [&](size_t b, size_t e) { sum += static_cast<int>(e - b); });
  });
  EXPECT_EQ(sum, 1000);
}

TEST(ParallelInvoke, RunsBothAndForwardsExceptions) {
  std::atomic<int> sum{0};
  parallelInvoke([&] { sum += 1; }, [&] { sum += 2; });
  EXPECT_EQ(sum, 3);
  EXPECT_THROW(parallelInvoke([] { throw std::logic_error("x"); }, [] {}), std::logic_error);
}

TEST(ThreadLimit, HoldsWhileItLives) {
  const int all = threadCount();
  EXPECT_GE(all, 1);
  {
    const ThreadLimit one(1);
    EXPECT_EQ(threadCount(), 1);
    std::mutex mutex;
    std::set<std::thread::id> threads;
    parallelFor(200, 1, [&](size_t, size_t) {
      const std::lock_guard lock(mutex);
      threads.insert(std::this_thread::get_id());
    });
    EXPECT_EQ(threads.size(), 1u);
    {
      const ThreadLimit default_(0);
      EXPECT_EQ(threadCount(), 1);  // the stricter one counts
    }
  }
  EXPECT_EQ(threadCount(), all);
}

TEST(Statistics, KeepsOrderAndSums) {
  Statistics s;
  s.set("b", "x", 1);
  s.set("a", "y", 2);
  s.add("b", "x", 3);
  s.add("a", "new", 0.5);
  s.set("a", "text", "words");
  EXPECT_EQ(s.value("b", "x"), 4);
  EXPECT_EQ(s.value("a", "new"), 0.5);
  EXPECT_EQ(s.value("a", "missing"), 0);
  const auto e = s.entries();
  ASSERT_EQ(e.size(), 4u);
  EXPECT_EQ(e[0].name, "x");
  EXPECT_EQ(e[1].section, "a");
  EXPECT_EQ(e[3].text, "words");
  s.set("a", "text", 7);
  EXPECT_TRUE(s.entries()[3].text.empty());
  EXPECT_EQ(s.value("a", "text"), 7);
}

}  // namespace
}  // namespace lampyris
