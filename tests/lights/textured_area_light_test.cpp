// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>

#include "core/error.h"
#include "core/sampling.h"
#include "light_maker.h"
#include "lights/picture_means.h"
#include "shapes/registry.h"
#include "shapes/triangle_mesh.h"
#include "support/statistics.h"

namespace lampyris::test {
namespace {

Image randomImage(int width, int height) {
  Image image(width, height, 3);
  for (size_t i = 0; i < image.data().size(); ++i)
    image.data()[i] = uniform(7, i, 0) < 0.6f ? 0.f : uniform(7, i, 1);
  return image;
}
Image dotImage(int width, int height, int x, int y) {
  Image image(width, height, 3);
  image.setRgb(x, y, Rgb(1000));
  return image;
}
std::string write(const std::string& name, const Image& image) {
  std::string path = testing::TempDir() + name;
  writeImageFile(path, image);
  return path;
}

std::shared_ptr<const EmissionImage> share(Image image) {
  return std::make_shared<const EmissionImage>(std::move(image));
}

using Triangle = std::array<Vec2, 3>;

/// Mean of the picture's luminance at points of a triangle, and the largest.
std::pair<double, double> bruteForce(const EmissionImage& picture, const Triangle& uv, int side) {
  double sum = 0, largest = 0;
  for (int i = 0; i < side * side; ++i) {
    const Vec2 b =
        sampleUniformTriangle((Vec2(i % side, i / side) + 0.5f) / static_cast<float>(side));
    const Vec2 at = b.x * uv[0] + b.y * uv[1] + (1 - b.x - b.y) * uv[2];
    const auto v = static_cast<double>(picture.bilinear({at.x, 1 - at.y}).luminance());
    sum += v;
    largest = std::max(largest, v);
  }
  return {sum / (side * side), largest};
}

Triangle randomTriangle(uint64_t i, float size) {
  const Vec2 corner = 6.f * Vec2(uniform(9, i, 0), uniform(9, i, 1)) - 3.f;
  const auto offset = [&](uint32_t d) {
    return size * (2.f * Vec2(uniform(9, i, d), uniform(9, i, d + 1)) - 1.f);
  };
  return {corner, corner + offset(2), corner + offset(4)};
}

double doubledArea(const Triangle& t) {
  const Vec2 a = t[1] - t[0], b = t[2] - t[0];
  return std::abs(static_cast<double>(a.x * b.y - a.y * b.x));
}

TEST(PictureMeans, AgreeWithBruteForce) {
  for (const Int2 size : {Int2(16, 16), Int2(13, 37), Int2(200, 3), Int2(1, 1)}) {
    const auto picture = share(randomImage(size.x, size.y));
    const PictureMeans means(picture, Rgb(1));
    const double whole = static_cast<double>(picture->mean().luminance());
    // Where texels are long, cells are, too.
    const bool square = std::max(size.x, size.y) < 10 * std::min(size.x, size.y);
    for (const float scale : {0.01f, 0.1f, 0.7f, 4.f}) {
      double error = 0;
      int count = 0;
      for (uint64_t i = 0; i < 200; ++i) {
        const Triangle t = randomTriangle(i, scale);
        if (doubledArea(t) < 0.1 * static_cast<double>(scale * scale)) continue;
        const double expected = bruteForce(*picture, t, 64).first;
        const double got = static_cast<double>(means.over(t));
        error += std::abs(got - expected) / whole;
        ++count;
        if (square) {
          EXPECT_NEAR(got, expected, 0.1 * expected + 0.1 * whole);
        }
      }
      EXPECT_LT(error / count, square ? 0.03 : 0.12) << size.x << " " << scale;
    }
  }
}

TEST(PictureMeans, LoseNothingAndFindBlack) {
  for (const Int2 dot : {Int2(0, 0), Int2(63, 47), Int2(30, 20)}) {
    const auto picture = share(dotImage(64, 48, dot.x, dot.y));
    const PictureMeans means(picture, Rgb(1));
    int lit = 0, black = 0;
    for (const float scale : {1e-6f, 1e-3f, 0.03f, 0.3f, 1.f})
      for (uint64_t i = 0; i < 1000; ++i) {
        Triangle t = randomTriangle(i, scale);
        // Near the dot, in any of its repetitions.
        const Vec2 centre((static_cast<float>(dot.x) + 0.5f) / 64,
                          1 - (static_cast<float>(dot.y) + 0.5f) / 48);
        for (Vec2& c : t)
          c = 0.01f * (c - t[0]) / 0.01f + centre + glm::floor(t[0]) +
              0.05f * (2.f * Vec2(uniform(5, i, 0), uniform(5, i, 1)) - 1.f);
        const float mean = means.over(t);
        if (bruteForce(*picture, t, 12).second > 0) {
          ++lit;
          EXPECT_GT(mean, 0);
        }
        black += mean == 0;
      }
    EXPECT_GT(lit, 150);
    EXPECT_GT(black, 500);
    EXPECT_EQ(means.over({Vec2(0.5f) + Vec2(0.2f, 0.3f), Vec2(0.71f, 0.8f), Vec2(0.7f, 0.81f)}) > 0,
              false);
  }
}

TEST(PictureMeans, AnyTriangle) {
  const auto picture = share(randomImage(20, 20));
  const PictureMeans means(picture, Rgb(2, 0, 0));
  const float whole = 2 * picture->mean().r * Rgb(1, 0, 0).luminance();
  const Vec2 a(0.3f, 0.4f);
  EXPECT_GE(means.over({a, a, a}), 0);
  EXPECT_GT(means.over({Vec2(0), Vec2(1), Vec2(2)}), 0) << "a line";
  EXPECT_NEAR(means.over({Vec2(0), Vec2(0, 1e6f), Vec2(1e6f, 0)}), whole, 1e-3f * whole);
  EXPECT_NEAR(means.over({Vec2(1e30f), Vec2(-1e30f), Vec2(1e30f, 0)}), whole, 1e-3f * whole);
  EXPECT_NEAR(means.over({Vec2(std::nanf("")), Vec2(kInfinity), Vec2(0)}), whole, 1e-3f * whole);
  EXPECT_NEAR(means.over({Vec2(-7, 3), Vec2(-6, 3), Vec2(-7, 4)}),
              means.over({Vec2(0, 0), Vec2(1, 0), Vec2(0, 1)}), 1e-4f * whole);
}

/// A square in z = 0 of n × n × 2 triangles; uv = its coordinates in [0, 1], times `repeat`.
TriangleMeshData grid(uint32_t n, float repeat) {
  TriangleMeshData data;
  for (uint32_t y = 0; y <= n; ++y)
    for (uint32_t x = 0; x <= n; ++x) {
      const Vec2 at = Vec2(x, y) / static_cast<float>(n);
      data.positions.emplace_back(at.x, at.y, 0);
      data.uvs.push_back(repeat * at);
    }
  for (uint32_t y = 0; y < n; ++y)
    for (uint32_t x = 0; x < n; ++x) {
      const uint32_t i = y * (n + 1) + x;
      data.indices.insert(data.indices.end(), {i, i + 1, i + n + 2, i, i + n + 2, i + n + 1});
    }
  return data;
}

class Emitters : public testing::Test {
 protected:
  Emitters() {
    maker_.build.textures.addRgb("waves", [](const SurfaceInteraction& at) {
      return Rgb(1 + std::sin(9 * at.uv.x + 4 * at.uv.y), std::abs(at.p.x), at.uv.y - 0.2f);
    });
    maker_.build.textures.addRgb("spot", [](const SurfaceInteraction& at) {
      return Rgb(length(Vec3(at.uv.x - 0.512f, at.uv.y - 0.487f, 0)) < 1e-3f ? 1e4f : 0.f);
    });
    maker_.build.textures.addRgb("faulty", [](const SurfaceInteraction& at) {
      return at.uv.x < 0.5f ? Rgb(std::nanf("")) : Rgb(-1, 1, -1);
    });
  }
  std::unique_ptr<Shape> make(const std::string& name, const TestParameters::List& list = {}) {
    const auto& plugin = shapeRegistry().get(name, {});
    const TestParameters p(plugin.schema, list);
    return plugin.create(
        p.set(), ShapeContext{maker_.build.base(), maker_.build.textures, Transform(), false});
  }
  static std::unique_ptr<Shape> makeGrid(uint32_t n, float repeat = 1) {
    return std::make_unique<TriangleMesh>(grid(n, repeat), Transform(), false);
  }
  std::vector<std::unique_ptr<Shape>> shapes() {
    std::vector<std::unique_ptr<Shape>> all;
    all.push_back(makeGrid(1, 2.5f));
    all.push_back(make("sphere", {{"radius", "0.5"}}));
    all.push_back(make("sphere", {{"zmin", "-0.5"}, {"phimax", "250"}}));
    all.push_back(make("disk"));
    all.push_back(make("cylinder", {{"phimax", "200"}}));
    return all;
  }

  LightMaker maker_;
};

/// What light sampling finds, what a ray that meets the same point finds, and what an integral
/// over directions finds is the same light.
TEST_F(Emitters, SamplingAndHitsSeeTheSameLight) {
  const std::string picture = write("same.pfm", randomImage(9, 5));
  const Vec3 from(0.3f, -0.4f, 2), normal = normalize(Vec3(0.1f, 0.2f, -1));
  const Frame frame = Frame::fromZ(normal);
  for (const auto& shape : shapes())
    for (const TestParameters::List& list :
         {TestParameters::List{{"L", "@waves"}, {"twosided", "true"}},
          TestParameters::List{{"filename", picture}, {"scale", "2 1 1"}, {"twosided", "true"}}}) {
      const auto light = maker_.makeArea(*shape, list);
      double sampled = 0;
      std::vector<double> found;
      const int count = 40'000;
      int checked = 0;
      for (uint32_t e = 0; e < shape->elementCount(); ++e)
        for (uint64_t i = 0; i < count; ++i) {
          const Vec2 u(uniform(1, i, 2 * e), uniform(1, i, 2 * e + 1));
          const auto s = light->sample(e, from, u);
          if (!s) continue;
          const float cosine = std::max(dot(normal, s->wi), 0.f);
          // Of several points along a ray the nearest counts.
          const auto hit = shape->intersect(e, {from, s->wi});
          if (!hit || std::abs(hit->t - s->distance) > 1e-3f * s->distance) continue;
          sampled += static_cast<double>(s->radiance.g * cosine / s->pdf) / count;
          if (i % 100) continue;
          ++checked;
          SurfaceInteraction at;
          shape->surface(e, *hit, {from, s->wi}, SurfaceDetail::Full, at);
          at.duvdx = {0.3f, 0.4f};  // a footprint changes nothing
          const Rgb seen = light->emitted(at, -s->wi);
          EXPECT_NEAR(seen.r, s->radiance.r, 2e-2f);
          EXPECT_NEAR(seen.b, s->radiance.b, 2e-2f);
        }
      EXPECT_GT(checked, 50);
      for (uint64_t i = 0; i < count; ++i) {
        const Vec3 w = frame.toWorld(sampleCosineHemisphere({uniform(2, i, 0), uniform(2, i, 1)}));
        std::optional<ShapeHit> nearest;
        uint32_t element = 0;
        for (uint32_t e = 0; e < shape->elementCount(); ++e)
          if (const auto hit = shape->intersect(e, {from, w}))
            if (!nearest || hit->t < nearest->t) nearest = hit, element = e;
        SurfaceInteraction at;
        if (nearest) shape->surface(element, *nearest, {from, w}, SurfaceDetail::Basic, at);
        found.push_back(nearest ? static_cast<double>(kPi * light->emitted(at, -w).g) : 0);
      }
      EXPECT_EQ(meanTest(found, sampled, 0.03 * sampled), "");
    }
}

TEST_F(Emitters, TrianglesCountByTheirPartOfThePicture) {
  const Image image = randomImage(24, 17);
  const EmissionImage picture(image);
  const auto mesh = makeGrid(20);
  const auto light =
      maker_.makeArea(*mesh, {{"filename", write("parts.pfm", image)}, {"scale", "3 3 3"}});
  double sum = 0;
  for (uint32_t e = 0; e < light->elementCount(); ++e) {
    const auto corner = [&](const Vec2& b) {
      SurfaceInteraction at;
      mesh->surface(e, {0, b}, Ray(), SurfaceDetail::Basic, at);
      return at.uv;
    };
    const double expected =
        3 * bruteForce(picture, {corner({0, 0}), corner({1, 0}), corner({0, 1})}, 32).first;
    const auto area = static_cast<double>(mesh->area(e));
    const auto got = static_cast<double>(light->bounds(e)->intensity);
    EXPECT_NEAR(got, area * expected, area * (0.1 * expected + 0.06));
    EXPECT_NEAR(light->power(e).luminance(), kPi * light->bounds(e)->intensity,
                1e-5f * light->power(e).luminance());
    sum += got;
  }
  EXPECT_NEAR(sum, 3 * static_cast<double>(picture.mean().luminance()), 0.03 * sum);
}

TEST_F(Emitters, OneBrightTexel) {
  const auto mesh = makeGrid(40);
  const auto light =
      maker_.makeArea(*mesh, {{"filename", write("dot.pfm", dotImage(32, 32, 8, 20))}});
  int dark = 0;
  for (uint32_t e = 0; e < light->elementCount(); ++e) {
    bool lit = false;
    for (uint64_t i = 0; i < 60 && !lit; ++i)
      lit = light->sample(e, {0.4f, 0.5f, 3}, {uniform(1, i, e), uniform(2, i, e)}).has_value();
    if (lit) {
      EXPECT_GT(light->bounds(e)->intensity, 0);
      EXPECT_FALSE(light->power(e).isBlack());
    }
    dark += light->bounds(e)->intensity == 0;
  }
  // Its hat covers 2 × 2 texels, so 2.5 × 2.5 of the mesh's squares.
  EXPECT_GE(dark, 2 * (1600 - 20));
}

TEST_F(Emitters, ProceduralTexturesLoseNothing) {
  for (const uint32_t n : {1u, 30u, 120u}) {
    const auto mesh = makeGrid(n);
    const auto spot = maker_.makeArea(*mesh, {{"L", "@spot"}});
    for (uint32_t e = 0; e < spot->elementCount(); ++e) ASSERT_GT(spot->bounds(e)->intensity, 0);
    const auto waves = maker_.makeArea(*mesh, {{"L", "@waves"}, {"scale", "2 2 2"}});
    double sum = 0, expected = 0;
    for (uint32_t e = 0; e < waves->elementCount(); ++e)
      sum += static_cast<double>(waves->bounds(e)->intensity);
    const int side = 300;
    for (int i = 0; i < side * side; ++i) {
      const Vec2 uv = (Vec2(i % side, i / side) + 0.5f) / static_cast<float>(side);
      expected +=
          2 *
          static_cast<double>(
              Rgb(1 + std::sin(9 * uv.x + 4 * uv.y), uv.x, std::max(0.f, uv.y - 0.2f)).luminance());
    }
    EXPECT_NEAR(sum, expected / (side * side), 0.03 * sum) << n;
  }
}

TEST_F(Emitters, QuadricsCountByTheirMean) {
  Image half(2, 1, 3);
  half.setRgb(1, 0, Rgb(6));
  const std::string path = write("half.pfm", half);
  for (const auto& shape : shapes()) {
    if (shape->elementCount() > 1) continue;
    const auto constant = maker_.makeArea(*shape, {{"L", "3 3 3"}});
    const auto light = maker_.makeArea(*shape, {{"filename", path}});
    EXPECT_NEAR(light->bounds(0)->intensity, constant->bounds(0)->intensity,
                0.05f * constant->bounds(0)->intensity);
  }
  const auto sphere = make("sphere");
  const auto black = maker_.makeArea(*sphere, {{"filename", write("black.pfm", Image(4, 4, 3))}});
  EXPECT_TRUE(black->power(0).isBlack());
}

TEST_F(Emitters, PicturesStandUprightAndAreDecoded) {
  Image image(2, 2, 3);
  image.setRgb(0, 0, Rgb(0.5f));  // upper left: u = 0.25, v = 0.75
  const auto mesh = makeGrid(1);
  SurfaceInteraction at;
  at.n = {0, 0, 1};
  for (const char* ending : {"png", "pfm"}) {
    const auto light = maker_.makeArea(
        *mesh, {{"filename", write(std::string("upright.") + ending, image)}, {"L", "2 2 2"}});
    at.uv = {0.25f, 0.75f};
    EXPECT_NEAR(light->emitted(at, {0, 0, 1}).g, 1, 0.01f) << ending;
    EXPECT_TRUE(light->emitted(at, {0, 0, -1}).isBlack());
    at.uv = {-0.75f, 3.75f};
    EXPECT_NEAR(light->emitted(at, {0, 0, 1}).g, 1, 0.01f);
    at.uv = {0.25f, 0.25f};
    EXPECT_EQ(light->emitted(at, {0, 0, 1}).g, 0);
  }
}

TEST_F(Emitters, FaultyTexturesEmitNoNonsense) {
  const auto mesh = makeGrid(2);
  const auto light = maker_.makeArea(*mesh, {{"L", "@faulty"}});
  for (uint32_t e = 0; e < light->elementCount(); ++e) {
    EXPECT_TRUE(std::isfinite(light->bounds(e)->intensity));
    for (uint64_t i = 0; i < 50; ++i)
      if (const auto s = light->sample(e, {0, 0, 1}, {uniform(1, i, 0), uniform(1, i, 1)})) {
        EXPECT_TRUE(s->radiance == Rgb(0, 1, 0));
      }
  }
}

TEST_F(Emitters, FaultyInput) {
  const auto mesh = makeGrid(1);
  const std::string picture = write("fine.pfm", randomImage(2, 2));
  EXPECT_THROW(maker_.makeArea(*mesh, {{"L", "@waves"}, {"L", "1 1 1"}}), SceneError);
  EXPECT_THROW(maker_.makeArea(*mesh, {{"L", "1 1 1"}, {"L", "@waves"}}), SceneError);
  EXPECT_THROW(maker_.makeArea(*mesh, {{"L", "@waves"}, {"filename", picture}}), SceneError);
  EXPECT_THROW(maker_.makeArea(*mesh, {{"L", "@none"}}), SceneError);
  EXPECT_THROW(maker_.makeArea(*mesh, {{"filename", "/no/such.png"}}), SceneError);
  EXPECT_NO_THROW(maker_.makeArea(*mesh, {{"L", "2 2 2"}, {"filename", picture}}));
  EXPECT_NO_THROW(maker_.makeArea(*mesh, {{"L", "2 2 2"}, {"L", "3 3 3"}}));
}

}  // namespace
}  // namespace lampyris::test
