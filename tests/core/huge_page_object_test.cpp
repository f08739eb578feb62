// SPDX-License-Identifier: Apache-2.0
#include "core/huge_page_object.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <memory>
#include <thread>
#include <vector>

namespace lampyris {
namespace {

struct Base {
  virtual ~Base() = default;
};
/// Half a cache line.
struct Small final : Base, HugePageObject {
  explicit Small(uint64_t v) : value(v) {}
  uint64_t value;
  uint64_t rest[2] = {};
};
static_assert(sizeof(Small) == 32);

using Objects = std::vector<std::unique_ptr<Base>>;

Objects makeObjects(size_t count) {
  Objects objects;
  for (size_t i = 0; i < count; ++i) objects.push_back(std::make_unique<Small>(i));
  return objects;
}
uint64_t valueOf(const std::unique_ptr<Base>& p) { return static_cast<const Small&>(*p).value; }
uintptr_t addressOf(const std::unique_ptr<Base>& p) { return reinterpret_cast<uintptr_t>(p.get()); }

TEST(HugePageObject, LieSideBySideWithinCacheLines) {
  const Objects objects = makeObjects(1000);
  size_t gaps = 0;
  for (size_t i = 0; i < objects.size(); ++i) {
    EXPECT_EQ(addressOf(objects[i]) % sizeof(Small), 0u);
    if (i > 0) gaps += addressOf(objects[i]) != addressOf(objects[i - 1]) + sizeof(Small);
  }
  EXPECT_LE(gaps, 1u);  // where a new page begins
}

TEST(HugePageObject, OutliveTheirThreadAndTheirNeighbours) {
  constexpr size_t kCount = 200'000;  // several pages
  Objects objects;
  std::thread([&] { objects = makeObjects(kCount); }).join();
  for (size_t i = 0; i < kCount; ++i)
    if (i % 70'000) objects[i].reset();
  for (size_t i = 0; i < kCount; i += 70'000) EXPECT_EQ(valueOf(objects[i]), i);
}

}  // namespace
}  // namespace lampyris
