// SPDX-License-Identifier: Apache-2.0
#include "film/light_image.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "core/parallel.h"
#include "film/filter_registry.h"
#include "support/statistics.h"

namespace lampyris::test {
namespace {

std::unique_ptr<Filter> filter(const std::string& name) {
  return filterRegistry().get(name, {}).create({}, {});
}

struct Splat {
  Vec2 at;
  Rgb value;
};
std::vector<Splat> splats(size_t count, float scale = 1) {
  std::vector<Splat> all(count);
  for (size_t i = 0; i < count; ++i)
    all[i] = {{12 * uniform(1, i, 0) - 2, 10 * uniform(1, i, 1) - 2},
              scale * Rgb(uniform(1, i, 2), 100 * uniform(1, i, 3), 1e-3f * uniform(1, i, 4))};
  return all;
}

TEST(LightImage, SumsDoNotDependOnTheOrder) {
  const auto gaussian = filter("gaussian");
  const PixelBounds bounds{{0, 0}, {8, 6}};
  auto all = splats(20'000);
  LightImage one(bounds, gaussian.get()), other(bounds, gaussian.get());
  one.open(1);
  other.open(1);
  for (const Splat& s : all) one.add(s.at, s.value);
  std::reverse(all.begin(), all.end());
  const ThreadLimit threads(4);
  parallelFor(all.size(), 10, [&](size_t begin, size_t end) {
    for (size_t i = begin; i < end; ++i) other.add(all[i].at, all[i].value);
  });
  EXPECT_EQ(one.encode(), other.encode());
}

TEST(LightImage, MeansAreThoseOfTheSplats) {
  const auto box = filter("box");
  const PixelBounds bounds{{2, 1}, {6, 5}};
  for (const float scale : {1e-20f, 1.f, 1e20f}) {
    LightImage image(bounds, box.get());
    image.open(static_cast<double>(scale));
    std::vector<double> expected(16);
    for (const Splat& s : splats(5000, scale)) {
      image.add(s.at, s.value);
      const Int2 p = glm::floor(s.at);
      if (bounds.contains(p))
        expected[static_cast<size_t>((p.y - 1) * 4 + p.x - 2)] += static_cast<double>(s.value.g);
    }
    image.addPaths(5000);
    // 16 pixels share the paths.
    for (size_t i = 0; i < 16; ++i)
      EXPECT_NEAR(image.mean(i)[1] / (expected[i] * 16 / 5000), 1, 1e-5);
  }
}

TEST(LightImage, FiltersKeepTheSum) {
  for (const char* name : {"box", "triangle", "gaussian", "mitchell", "sinc"}) {
    const auto f = filter(name);
    LightImage image({{0, 0}, {16, 16}}, f.get());
    image.open(1);
    double sum = 0;
    for (uint64_t i = 0; i < 400; ++i)
      image.add(Vec2(6) + 4.f * Vec2(uniform(2, i, 0), uniform(2, i, 1)), Rgb(1));
    image.addPaths(256);
    for (size_t i = 0; i < 256; ++i) sum += image.mean(i)[0];
    EXPECT_NEAR(sum, 400, 4) << name;
  }
}

TEST(LightImage, TakesAnyPlaceAndValue) {
  const auto gaussian = filter("gaussian");
  LightImage image({{0, 0}, {4, 4}}, gaussian.get());
  image.open(1e-12);
  for (const float x : {-1e30f, 1e30f, -1e9f, 1e9f, 2.f}) image.add({x, x}, Rgb(1e30f));
  image.addPaths(16);
  EXPECT_GT(image.mean(5)[0], 0);
}

TEST(LightImage, IsRestored) {
  const auto box = filter("box");
  const PixelBounds bounds{{0, 0}, {8, 6}};
  LightImage image(bounds, box.get()), again(bounds, box.get());
  image.open(3);
  for (const Splat& s : splats(100)) image.add(s.at, s.value);
  image.addPaths(7);
  std::string bytes = image.encode();
  EXPECT_EQ(bytes.size(), again.encodedSize());
  ASSERT_TRUE(again.decode(bytes));
  EXPECT_EQ(again.encode(), bytes);
  bytes[40] ^= 4;
  EXPECT_FALSE(again.decode(bytes));
  EXPECT_FALSE(again.decode(""));
}

}  // namespace
}  // namespace lampyris::test
