// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <deque>
#include <filesystem>
#include <limits>

#include "core/image.h"
#include "core/image_layers.h"
#include "core/math.h"
#include "film/film_registry.h"
#include "film/filter_registry.h"
#include "film/pixel_sums.h"
#include "support/statistics.h"

namespace lampyris {
namespace {

class ImageFilmTest : public testing::Test {
 protected:
  struct Values {
    int x = 8, y = 6;
    std::vector<float> crop{};
    float scale = 1, maxLuminance = 0;
    std::string filename = "out.exr";
    std::string aovs = "";
  };

  std::unique_ptr<Film> make(const Values& v) {
    const int32_t x[] = {v.x}, y[] = {v.y};
    const float scale[] = {v.scale}, luminance[] = {v.maxLuminance};
    const std::string_view filename[] = {v.filename};
    std::vector<Parameter> p(4);
    p[0] = {"xresolution", {0, 10}, ParameterType::Integer, {}, x, {}};
    p[1] = {"yresolution", {0, 11}, ParameterType::Integer, {}, y, {}};
    p[2] = {"scale", {0, 12}, ParameterType::Float, scale, {}, {}};
    p[3] = {"filename", {0, 13}, ParameterType::String, {}, {}, filename};
    const std::string_view aovs[] = {v.aovs};
    if (!v.aovs.empty()) p.push_back({"aovs", {0, 16}, ParameterType::String, {}, {}, aovs});
    if (!v.crop.empty()) p.push_back({"cropwindow", {0, 14}, ParameterType::Float, v.crop, {}, {}});
    if (v.maxLuminance > 0)
      p.push_back({"maxsampleluminance", {0, 15}, ParameterType::Float, luminance, {}, {}});
    return filmRegistry().get("image", {}).create({p, {}}, context_);
  }
  std::string errorOf(const Values& v, uint64_t offset) {
    try {
      make(v);
    } catch (const SceneError& e) {
      EXPECT_EQ(e.location.offset, offset) << e.what();
      return e.what();
    }
    return "";
  }

  SourceFiles files_;
  Diagnostics diagnostics_{files_, [](const std::string&) {}};
  std::unique_ptr<Filter> filter_ = filterRegistry().get("box", {}).create({}, {});
  FilmContext context_{{diagnostics_, [](const std::string& p) { return p; }, {0, 5}}, filter_};
};

TEST_F(ImageFilmTest, DefaultsOfPbrt) {
  const auto film = filmRegistry().get("image", {}).create({}, context_);
  EXPECT_EQ(film->resolution(), Int2(1280, 720));
  EXPECT_EQ(film->bounds(), (PixelBounds{{0, 0}, {1280, 720}}));
  EXPECT_EQ(film->filename(), "lampyris.exr");
  EXPECT_EQ(film->filter().radius(), Vec2(0.5f));
  EXPECT_EQ(filter_, nullptr);
}

TEST_F(ImageFilmTest, PixelsAreWeightedMeans) {
  const auto film = make({.scale = 2});
  EXPECT_EQ(film->pixel({3, 2}), Rgb());
  EXPECT_TRUE(film->addSample({3, 2}, {1, 2, 3}, 1.5f));
  EXPECT_TRUE(film->addSample({3, 2}, {1, 0, 3}, 0.5f));
  EXPECT_EQ(film->sampleCount({3, 2}), 2u);
  EXPECT_EQ(film->sampleCount({2, 3}), 0u);
  EXPECT_EQ(film->pixel({3, 2}), Rgb(2, 3, 6));
  // A negative weight may leave a negative sum, which is no light.
  EXPECT_TRUE(film->addSample({0, 0}, {1, 1, 1}, -0.5f));
  EXPECT_EQ(film->pixel({0, 0}), Rgb());
}

TEST_F(ImageFilmTest, BrightSamplesAreDarkenedBeforeTheFilter) {
  const auto film = make({.maxLuminance = 2});
  film->addSample({0, 0}, Rgb(8), 1.5f);
  EXPECT_NEAR(film->pixel({0, 0}).g, 3, 1e-5);
  film->addSample({1, 0}, Rgb(1.5f), 3);
  EXPECT_FLOAT_EQ(film->pixel({1, 0}).g, 4.5f);
}

TEST_F(ImageFilmTest, InvalidRadianceCountsAsBlack) {
  const auto film = make({});
  const float inf = std::numeric_limits<float>::infinity();
  for (const Rgb& c :
       {Rgb(std::nanf(""), 0, 0), Rgb(0, inf, 0), Rgb(0, 0, -inf), Rgb(-1), Rgb(0, -1e-12f, 0)})
    EXPECT_FALSE(film->addSample({0, 0}, c, 1));
  EXPECT_EQ(film->sampleCount({0, 0}), 5u);
  EXPECT_EQ(film->pixel({0, 0}), Rgb());
  EXPECT_TRUE(film->addSample({0, 0}, Rgb(6), 1));
  EXPECT_EQ(film->pixel({0, 0}), Rgb(1));
  // A saturated cyan is outside the gamut of sRGB, but it is light.
  EXPECT_TRUE(film->addSample({1, 0}, {-0.5f, 1, 1}, 1));
  EXPECT_EQ(film->pixel({1, 0}), Rgb(0, 1, 1));
}

TEST_F(ImageFilmTest, ExtremeRadianceStaysFinite) {
  const auto film = make({.scale = 1e20f});
  for (int i = 0; i < 10; ++i) film->addSample({0, 0}, Rgb(3e38f), 1.2f);
  EXPECT_TRUE(film->pixel({0, 0}).isFinite());
  EXPECT_TRUE(std::isfinite(film->noise()));
  filter_ = filterRegistry().get("box", {}).create({}, {});
  const auto dark = make({});
  dark->addSample({0, 0}, Rgb(1e-12f), 1);
  EXPECT_FLOAT_EQ(dark->pixel({0, 0}).r, 1e-12f);
}

TEST_F(ImageFilmTest, CropBoundsOfPbrt) {
  EXPECT_EQ(make({.x = 10, .y = 10, .crop = {0.25f, 0.75f, 0, 0.5f}})->bounds(),
            (PixelBounds{{3, 0}, {8, 5}}));
  filter_ = filterRegistry().get("box", {}).create({}, {});
  EXPECT_EQ(make({.x = 10, .y = 10, .crop = {-1, 2, 0.85f, 1}})->bounds(),
            (PixelBounds{{0, 9}, {10, 10}}));
}

TEST_F(ImageFilmTest, CropErrors) {
  EXPECT_EQ(errorOf({.crop = {0, 1, 0}}, 14),
            "parameter \"cropwindow\": expected 4 values (x0 x1 y0 y1), got 3");
  EXPECT_EQ(errorOf({.crop = {0.5f, 0.5f, 0, 1}}, 14),
            "parameter \"cropwindow\": expected x0 < x1 and y0 < y1, got 0.5 0.5 0 1");
  EXPECT_EQ(errorOf({.crop = {0, 1, 1, 0}}, 14),
            "parameter \"cropwindow\": expected x0 < x1 and y0 < y1, got 0 1 1 0");
  EXPECT_EQ(errorOf({.crop = {0.51f, 0.52f, 0, 1}}, 14),
            "parameter \"cropwindow\": 0.51 0.52 0 1 holds no pixel of 8 x 6");
  EXPECT_NE(errorOf({.crop = {2, 3, 0, 1}}, 14), "");
}

TEST_F(ImageFilmTest, OtherErrors) {
  EXPECT_EQ(errorOf({.x = 0}, 10), "parameter \"xresolution\": 0 is outside [1, 1048576]");
  EXPECT_NE(errorOf({.y = -5}, 11), "");
  EXPECT_NE(errorOf({.x = 1 << 20, .y = 1 << 20}, 10), "");
  EXPECT_NE(errorOf({.scale = -1}, 12), "");
  EXPECT_NE(errorOf({.filename = "out.xyz"}, 13), "");
  EXPECT_NE(errorOf({.filename = ""}, 13), "");
  filter_ = nullptr;
  EXPECT_NE(errorOf({}, 5), "");
}

/// Adds samples that are a function of pixel and index.
void fill(Film& film, uint64_t first, uint64_t count) {
  const PixelBounds b = film.bounds();
  for (int y = b.min.y; y < b.max.y; ++y)
    for (int x = b.min.x; x < b.max.x; ++x)
      for (uint64_t i = first; i < first + count; ++i) {
        const auto pixel = static_cast<uint64_t>(y * 1000 + x);
        film.addSample({x, y}, {test::uniform(pixel, i, 0), test::uniform(pixel, i, 1), 0.3f},
                       2 * test::uniform(pixel, i, 2));
      }
}

TEST_F(ImageFilmTest, ResumingIsExact) {
  const Values values{.crop = {0.2f, 0.9f, 0, 1}};
  auto filter = [this] { filter_ = filterRegistry().get("box", {}).create({}, {}); };
  const auto whole = make(values);
  fill(*whole, 0, 20);
  filter();
  const auto half = make(values);
  fill(*half, 0, 9);
  const std::string saved = half->save();
  filter();
  const auto resumed = make(values);
  ASSERT_TRUE(resumed->restore(saved));
  EXPECT_EQ(resumed->save(), saved);
  fill(*resumed, 9, 11);
  EXPECT_EQ(resumed->save(), whole->save());
  EXPECT_EQ(resumed->pixel({4, 4}), whole->pixel({4, 4}));
  EXPECT_EQ(resumed->noise(), whole->noise());
}

TEST_F(ImageFilmTest, DamagedCheckpointsAreRefused) {
  const auto film = make({.x = 3, .y = 2});
  fill(*film, 0, 5);
  const std::string good = film->save();
  filter_ = filterRegistry().get("box", {}).create({}, {});
  const auto other = make({.x = 3, .y = 2});
  fill(*other, 7, 3);
  const std::string before = other->save();
  for (size_t i = 0; i < good.size(); ++i)
    for (const int bit : {0, 3, 7}) {
      std::string bad = good;
      bad[i] = static_cast<char>(bad[i] ^ 1 << bit);
      EXPECT_FALSE(other->restore(bad)) << i;
    }
  for (size_t n = 0; n < good.size(); ++n) EXPECT_FALSE(other->restore(good.substr(0, n)));
  EXPECT_FALSE(other->restore(good + "x"));
  EXPECT_FALSE(other->restore(std::string(good.size(), '\0')));
  EXPECT_EQ(other->save(), before);
  EXPECT_TRUE(other->restore(good));
  filter_ = filterRegistry().get("box", {}).create({}, {});
  // As many pixels, other bounds.
  EXPECT_FALSE(make({.x = 2, .y = 3})->restore(good));
}

TEST_F(ImageFilmTest, AovsByName) {
  EXPECT_TRUE(make({})->aovs().empty());
  const auto renew = [this] { filter_ = filterRegistry().get("box", {}).create({}, {}); };
  renew();
  const AovSet two = make({.aovs = "depth, time"})->aovs();
  EXPECT_TRUE(two.has(Aov::Depth) && two.has(Aov::Time) && !two.has(Aov::Albedo));
  for (const std::string_view name : kAovNames) {
    renew();
    EXPECT_FALSE(make({.aovs = std::string(name)})->aovs().empty()) << name;
  }
  renew();
  EXPECT_NE(errorOf({.aovs = "depth,normals"}, 16).find("did you mean \"normal\""),
            std::string::npos);
}

TEST_F(ImageFilmTest, AovsAreWrittenAndResumed) {
  const Values values{.x = 3, .y = 2, .crop = {0.3f, 1, 0, 1}, .aovs = "pathlength"};
  const auto film = make(values);
  ASSERT_EQ(film->bounds(), (PixelBounds{{1, 0}, {3, 2}}));
  fill(*film, 0, 2);
  AovRecord record;
  record.segments = 5;
  film->addAovs({2, 1}, record);
  const std::string path = testing::TempDir() + "lampyris_film_aovs.exr";
  film->write(path, {});
  const Image layer = readExrLayer(path, "pathlength");
  EXPECT_EQ(layer.width(), 2);
  EXPECT_EQ(layer.at(1, 1, 0), 2.5f);
  EXPECT_EQ(layer.at(0, 1, 0), 0);
  std::filesystem::remove(path);

  const auto renew = [this] { filter_ = filterRegistry().get("box", {}).create({}, {}); };
  const std::string saved = film->save();
  renew();
  const auto same = make(values);
  EXPECT_TRUE(same->restore(saved));
  EXPECT_EQ(same->save(), saved);
  // As many sums, of another AOV; and fewer.
  for (const char* aovs : {"time", ""}) {
    renew();
    Values other = values;
    other.aovs = aovs;
    EXPECT_FALSE(make(other)->restore(saved)) << aovs;
  }
}

TEST_F(ImageFilmTest, NoiseIsTheRelativeStandardError) {
  const auto film = make({.x = 64, .y = 64});
  EXPECT_TRUE(std::isinf(film->noise()));
  constexpr int kSamples = 25;
  for (int y = 0; y < 64; ++y)
    for (int x = 0; x < 64; ++x)
      for (uint64_t i = 0; i < kSamples; ++i)
        film->addSample({x, y}, Rgb(test::uniform(static_cast<uint64_t>(y * 64 + x), i, 0)), 1);
  // Variance 1/12, mean 1/2. 102400 draws: the estimate's own error is far below 2 %.
  EXPECT_NEAR(film->noise(), std::sqrt(1 / 12. / kSamples) / 0.5, 0.02 * 0.115);
}

TEST_F(ImageFilmTest, NoiseOfSpecialImages) {
  const auto black = make({});
  for (int i = 0; i < 3; ++i) black->addSample({0, 0}, Rgb(), 1);
  EXPECT_EQ(black->noise(), 0);
  filter_ = filterRegistry().get("box", {}).create({}, {});
  const auto constant = make({});
  for (int i = 0; i < 3; ++i) constant->addSample({0, 0}, Rgb(0.7f), 1);
  EXPECT_NEAR(constant->noise(), 0, 1e-6);
}

TEST_F(ImageFilmTest, WritesTheCropWindow) {
  const std::string folder = testing::TempDir() + "lampyris_film";
  std::filesystem::create_directories(folder);
  const auto film = make({.crop = {0.25f, 0.75f, 0.5f, 1}});
  ASSERT_EQ(film->bounds(), (PixelBounds{{2, 3}, {6, 6}}));
  fill(*film, 0, 4);
  for (const char* name : {"/a.exr", "/a.pfm"}) {
    film->write(folder + name, {{"key", "value"}});
    const Image image = readLinearImage(folder + name);
    ASSERT_GE(image.width(), 4);
    // EXR readers may give the whole display window; the crop then lies at its place in it.
    const Int2 offset = image.width() == 8 ? film->bounds().min : Int2(0);
    for (int y = 0; y < 3; ++y)
      for (int x = 0; x < 4; ++x)
        EXPECT_EQ(image.rgb(offset.x + x, offset.y + y), film->pixel({2 + x, 3 + y})) << name;
  }
  EXPECT_THROW(film->write(folder + "/no/such/folder/a.exr", {}), IoError);
  std::filesystem::remove_all(folder);
}

TEST(PixelSums, AreSmall) { EXPECT_LE(sizeof(PixelSums), 64u); }

}  // namespace
}  // namespace lampyris
