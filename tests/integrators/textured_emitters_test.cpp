// SPDX-License-Identifier: Apache-2.0
// Emitters with textures and pictures light a scene alike however their light is found.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <numeric>

#include "core/image.h"
#include "support/statistics.h"
#include "support/tiny_scenes.h"

namespace lampyris::test {
namespace {

/// A floor below what emits.
std::string world(const std::string& emitters) {
  return matte(0.5f) + square(3) + "AttributeBegin\nTranslate 0.3 0.2 1\n" + matte(0) + emitters +
         "AttributeEnd\n";
}
std::string emitter(const std::string& parameters, const std::string& shape) {
  return "AreaLightSource \"diffuse\" \"bool twosided\" \"true\" " + parameters + "\n" + shape;
}
/// A rectangle in z = 0 with uv from 0 to `uv`.
std::string rectangle(const Vec2& lo, const Vec2& hi, const Vec2& uv = Vec2(1)) {
  return fmt::format(
      "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3] \"point P\" [{0} {1} 0 {2} {1} 0 "
      "{2} {3} 0 {0} {3} 0] \"float uv\" [0 0 {4} 0 {4} {5} 0 {5}]\n",
      lo.x, lo.y, hi.x, hi.y, uv.x, uv.y);
}

/// The mean of a few points of the floor.
double render(const std::string& emitters, const std::string& integrator, uint64_t samples,
              std::vector<double>* values = nullptr) {
  TinyView view;
  view.lookAt = "0 0 0.2  0 0 0  0 1 0";
  view.integrator = integrator;
  TinyScene scene(tinyScene(view, world(emitters)));
  scene.render(samples);
  EXPECT_EQ(scene.badSamples(), 0);
  const std::vector<double> all = scene.greens();
  if (values) *values = all;
  return std::accumulate(all.begin(), all.end(), 0.) / static_cast<double>(all.size());
}

void expectAllAgree(const std::string& emitters, double expected) {
  EXPECT_GT(expected, 0.01);
  for (const char* integrator :
       {"\"path\"", "\"path\" \"string lightsampler\" \"power\"", "\"directlighting\""}) {
    std::vector<double> values;
    render(emitters, integrator, 256, &values);
    EXPECT_EQ(meanTest(values, expected, 0.01 * expected), "") << integrator << "\n" << emitters;
  }
}

TEST(TexturedEmitters, SquaresLightAsSquaresOfTheirOwn) {
  std::string squares;
  for (int i = 0; i < 7; ++i)
    for (int j = 0; j < 3; ++j) {
      const Vec2 size(2 / 7.f, 2 / 3.f), lo = Vec2(i, j) * size - 1.f;
      if ((i + j) % 2 == 0) squares += emitter("\"rgb L\" [5 5 5]", rectangle(lo, lo + size));
    }
  const std::string texture =
      "Texture \"squares\" \"spectrum\" \"checkerboard\" \"rgb tex1\" [5 5 5] \"rgb tex2\" [0 0 0] "
      "\"string aamode\" \"none\" \"float uscale\" 3.5 \"float vscale\" 1.5\n";
  const double expected = render(squares, "\"directlighting\"", 1024);
  expectAllAgree(
      texture + emitter("\"texture L\" \"squares\"", rectangle(Vec2(-1), Vec2(1), Vec2(2))),
      expected);
}

TEST(TexturedEmitters, PicturesLightAsTheirTexture) {
  Image image(8, 4, 3);
  for (size_t i = 0; i < image.data().size(); ++i)
    image.data()[i] = i < 40 ? 0.f : 5 * uniform(3, i, 0);
  const std::string path = testing::TempDir() + "emitter.pfm";
  writeImageFile(path, image);
  const std::string file = "\"string filename\" \"" + path + "\"";
  for (const std::string& shape : {rectangle(Vec2(-1), Vec2(1), Vec2(1.5f, 1)),
                                   std::string("Shape \"disk\" \"float radius\" 1\n"),
                                   std::string("Shape \"sphere\" \"float radius\" 0.5\n")}) {
    const std::string textured = "Texture \"t\" \"spectrum\" \"imagemap\" " + file + "\n" +
                                 emitter("\"texture L\" \"t\" \"rgb scale\" [2 2 2]", shape);
    const std::string pictured = emitter(file + " \"rgb scale\" [2 2 2]", shape);
    const double expected = render(pictured, "\"directlighting\"", 1024);
    expectAllAgree(pictured, expected);
    expectAllAgree(textured, expected);
  }
}

}  // namespace
}  // namespace lampyris::test
