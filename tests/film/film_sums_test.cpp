// SPDX-License-Identifier: Apache-2.0
#include "film/film_sums.h"

#include <gtest/gtest.h>

#include <numeric>
#include <random>

#include "film/filter_registry.h"
#include "support/statistics.h"

namespace lampyris::test {

namespace {

constexpr uint64_t kSamples = 23;

FilmFrame frame() {
  AovSet all;
  for (size_t i = 0; i < kAovNames.size(); ++i) all.add(static_cast<Aov>(i));
  return {{7, 5}, {{1, 0}, {6, 5}}, all, 2.5};
}

/// A film of which samples and splats are added by their numbers.
class TestFilm {
 public:
  TestFilm() : sums_(frame(), filter_.get()) { sums_.lightImage().open(1); }

  FilmSums& sums() { return sums_; }
  void add(uint64_t begin, uint64_t end) {
    const auto area = static_cast<size_t>(frame().bounds.area());
    for (uint64_t n = begin; n < end; ++n)
      for (size_t pixel = 0; pixel < area; ++pixel) addSample(pixel, n);
    sums_.lightImage().addPaths((end - begin) * area);
  }

 private:
  void addSample(size_t pixel, uint64_t n) {
    const auto u = [&](uint32_t d) { return static_cast<double>(uniform(pixel, n, d)); };
    // Brightness over twelve decades, weights of either sign.
    const double value = std::pow(10, 12 * u(0) - 6) * (u(1) < 0.2 ? -1 : 1);
    sums_.addSample(pixel, {value, value * u(2), value * u(3)}, value);
    AovRecord record;
    record.surface({static_cast<float>(u(4)), 0, 1}, {0, 0.6f, 0.8f},
                   Rgb(static_cast<float>(u(5))));
    record.beginLightVertex();
    record.lightDraw(static_cast<float>(u(6)));
    record.bsdfSampled(Rgb(static_cast<float>(u(7))));
    record.lightSampled(Rgb(static_cast<float>(u(8))));
    record.segments = n;
    record.seconds = u(9);
    sums_.aovs().add(pixel, record);
    sums_.lightImage().add({7 * uniform(pixel, n, 10), 5 * uniform(pixel, n, 11)},
                           Rgb(static_cast<float>(value * value)));
  }

  std::unique_ptr<Filter> filter_ = filterRegistry().get("gaussian", {}).create({}, {});
  FilmSums sums_;
};

std::string savedRange(uint64_t begin, uint64_t end) {
  TestFilm film;
  film.add(begin, end);
  return film.sums().save();
}

void expectSameImage(FilmSums& a, FilmSums& b) {
  for (size_t i = 0; i < static_cast<size_t>(frame().bounds.area()); ++i)
    ASSERT_EQ(a.pixel(i), b.pixel(i)) << i;
  EXPECT_TRUE(
      std::ranges::equal(a.aovs().values(), b.aovs().values(), {}, &WideSum::high, &WideSum::high));
  EXPECT_EQ(a.lightImage().encode(), b.lightImage().encode());
  EXPECT_NEAR(a.noise(), b.noise(), 1e-12 * b.noise());
}

TEST(FilmSums, AnySplitMergedInAnyOrderGivesTheSameBits) {
  TestFilm whole;
  whole.add(0, kSamples);
  std::mt19937 random(5);
  for (int round = 0; round < 40; ++round) {
    std::vector<uint64_t> cuts{0, kSamples};
    for (auto i = random() % 6; i > 0; --i) cuts.push_back(random() % (kSamples + 1));
    std::ranges::sort(cuts);
    std::vector<size_t> order(cuts.size() - 1);
    std::iota(order.begin(), order.end(), 0);
    std::shuffle(order.begin(), order.end(), random);
    std::unique_ptr<FilmSums> merged;
    for (const size_t i : order) {
      auto part = FilmSums::decode(savedRange(cuts[i], cuts[i + 1]));
      ASSERT_TRUE(part);
      if (merged)
        ASSERT_TRUE(merged->merge(*part));
      else
        merged = std::move(part);
    }
    expectSameImage(*merged, whole.sums());
  }
}

TEST(FilmSums, OtherFramesAndUnitsAreNotMerged) {
  TestFilm film;
  film.add(0, 3);
  const std::string before = film.sums().save();
  for (const int what : {0, 1, 2, 3}) {
    FilmFrame f = frame();
    if (what == 0) f.resolution.x = 8;
    if (what == 1) f.bounds.max.y = 4;
    if (what == 2) f.aovs = {};
    if (what == 3) f.scale = 2;
    EXPECT_FALSE(film.sums().merge(FilmSums(f))) << what;
  }
  FilmSums other(frame());
  other.lightImage().open(100);
  EXPECT_FALSE(film.sums().merge(other));
  EXPECT_EQ(film.sums().save(), before);
}

TEST(FilmSums, DamagedBytesAreNoFilm) {
  std::string bytes = savedRange(0, 2);
  ASSERT_TRUE(FilmSums::decode(bytes));
  EXPECT_FALSE(FilmSums::decode(""));
  for (size_t size = 0; size < bytes.size(); size += 8)
    EXPECT_FALSE(FilmSums::decode(std::string_view(bytes).substr(0, size))) << size;
  for (size_t at = 0; at < bytes.size(); at += 11) {
    bytes[at] = static_cast<char>(bytes[at] ^ 16);
    EXPECT_FALSE(FilmSums::decode(bytes)) << at;
    bytes[at] = static_cast<char>(bytes[at] ^ 16);
  }
}

}  // namespace
}  // namespace lampyris::test
