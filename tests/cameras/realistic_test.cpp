// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>

#include "cameras/exit_pupil.h"
#include "cameras/lens_file.h"
#include "cameras/registry.h"
#include "support/statistics.h"

namespace lampyris::test {
namespace {

/// A biconvex lens of about 50 mm, then a stop.
const char* const kSinglet = "# made for tests\n40 6 1.5168 24\n-60 2 1 24 # the back\n0 30 0 12\n";

LensSystem singlet(double stopRadius = 0.006) {
  auto elements = readLens(kSinglet);
  elements.back().apertureRadius = stopRadius;
  return LensSystem(std::move(elements));
}

std::string lensError(const std::string& text) {
  try {
    LensSystem lens(readLens(text));
    return "";
  } catch (const std::runtime_error& e) {
    return e.what();
  }
}

TEST(LensFile, ReadsNumbersAndComments) {
  const auto elements = readLens(kSinglet);
  ASSERT_EQ(elements.size(), 3u);
  EXPECT_NEAR(elements[0].curvatureRadius, 0.04, 1e-12);
  EXPECT_NEAR(elements[1].thickness, 0.002, 1e-12);
  EXPECT_EQ(elements[0].eta, 1.5168);
  EXPECT_NEAR(elements[2].apertureRadius, 0.006, 1e-12);
  EXPECT_TRUE(elements[2].isStop());
  EXPECT_EQ(readLens("+1 2 3 4#").size(), 1u);
}

TEST(LensFile, SaysWhatIsWrong) {
  EXPECT_NE(lensError("").find("this one 0 numbers"), std::string::npos);
  EXPECT_NE(lensError("# nothing").find("this one 0 numbers"), std::string::npos);
  EXPECT_NE(lensError("40 6 1.5").find("this one 3 numbers"), std::string::npos);
  EXPECT_EQ(lensError("40 6\n1.5 wide"), "line 2: expected a number, got \"wide\"");
  EXPECT_EQ(lensError("40 6\n\n1.5e 3"), "line 3: expected a number, got \"1.5e\"");
  EXPECT_NE(lensError("40 -6 1.5 24").find("element 1: its thickness"), std::string::npos);
  EXPECT_NE(lensError("40 6 1.5 24 -40 6 1 0").find("element 2: its aperture"), std::string::npos);
  EXPECT_NE(lensError("40 6 -1.5 24").find("index of refraction"), std::string::npos);
  EXPECT_NE(lensError("nan 6 1.5 24").find("finite"), std::string::npos);
  EXPECT_NE(lensError(std::string(100, '\0')), "");
}

TEST(LensSystem, PathsAreReversible) {
  const LensSystem lens = singlet();
  int passed = 0;
  for (uint64_t i = 0; i < 500; ++i) {
    const DVec3 film(0.01 * static_cast<double>(uniform(1, i, 0)), 0.005, 0);
    const DVec3 rear(0.014 * static_cast<double>(uniform(1, i, 1)) - 0.007,
                     0.014 * static_cast<double>(uniform(1, i, 2)) - 0.007, lens.rearZ());
    const auto out = lens.traceFromFilm({film, rear - film});
    const bool inStop = glm::length(glm::dvec2(rear)) < 0.006;
    EXPECT_EQ(out.has_value(), inStop);
    if (!out) continue;
    ++passed;
    const auto back = lens.traceFromScene({out->at(0.1), -out->d});
    ASSERT_TRUE(back);
    const DVec3 p = back->at(-back->o.z / back->d.z);
    EXPECT_LT(glm::length(p - film), 1e-12);
  }
  EXPECT_GT(passed, 100);
}

TEST(LensSystem, FocusesAtTheDistance) {
  for (const double distance : {0.3, 1., 5., 1000.}) {
    LensSystem lens = singlet();
    lens.focus(distance, 1e-5);
    // A ray near the axis from the film's centre meets the axis there.
    const auto ray = lens.traceFromFilm({DVec3(0), DVec3(1e-4, 0, lens.rearZ())});
    ASSERT_TRUE(ray);
    const double z = ray->at(-ray->o.x / ray->d.x).z;
    EXPECT_NEAR(1 / z, 1 / distance, 3e-3);
  }
  // The lensmaker's equation: 1/f = (n − 1) (1/R1 − 1/R2 + (n − 1) d / (n R1 R2)).
  const double n = 1.5168, power = (n - 1) * (25 + 1 / 0.06 - (n - 1) * 0.006 / (n * 0.04 * 0.06));
  const auto out = singlet().traceFromScene({{1e-5, 0, 1}, {0, 0, -1}});
  ASSERT_TRUE(out);
  EXPECT_NEAR(1e-5 / (-out->d.x / -out->d.z), 1 / power, 1e-5);
  for (const double tooShort : {1e-3, 0.1}) {
    LensSystem lens = singlet();
    EXPECT_THROW(lens.focus(tooShort, 1e-5), std::runtime_error);
  }
  LensSystem window(std::vector<LensElement>{{0, 0.03, 0, 0.005}});
  EXPECT_THROW(window.focus(1, 1e-5), std::runtime_error);
}

TEST(ExitPupil, IsTheStopWhereItIsLast) {
  // The lens is much wider than the stop, which is seen whole from all of the film.
  for (const double radius : {1e-5, 0.001, 0.004}) {
    const LensSystem lens = singlet(radius);
    const ExitPupil pupil(lens, 0.008);
    const double margin = 2 * 3 * std::sqrt(2.) * radius / 1024;
    for (const double distance : {0., 0.003, 0.0079, 0.009}) {
      const PupilBox& b = pupil.box(distance);
      EXPECT_NEAR(b.max.x, radius + margin, 1e-3 * radius);
      EXPECT_NEAR(b.max.y, radius + margin, 1e-3 * radius);
      EXPECT_NEAR(b.min.x, -radius - margin, 1e-3 * radius);
      EXPECT_NEAR(b.min.y, -radius - margin, 1e-3 * radius);
    }
  }
}

TEST(ExitPupil, HoldsEveryRayThatPasses) {
  // A stop in front of a lens: the pupil moves and is cut off towards the corners.
  auto elements = readLens("0 8 0 5\n60 5 1.6 30\n-45 50 1 16");
  for (const double stop : {0.0025, 2e-5}) {
    elements[0].apertureRadius = stop;
    const LensSystem lens(elements);
    const double filmRadius = 0.02;
    const ExitPupil pupil(lens, filmRadius);
    int passed = 0;
    for (uint64_t i = 0; i < 4000; ++i) {
      const double x = filmRadius * static_cast<double>(uniform(2, i, 0));
      // Aimed through the stop, backwards.
      const DVec3 front(stop * (2 * static_cast<double>(uniform(2, i, 1)) - 1),
                        stop * (2 * static_cast<double>(uniform(2, i, 2)) - 1), 0.1);
      const DVec3 film(x, 0, 0);
      glm::dvec2 rear(0);  // found by Newton's method in two dimensions, by differences
      const auto misses = [&](const glm::dvec2& p) -> std::optional<glm::dvec2> {
        auto wide = elements;
        wide[0].apertureRadius = 1;
        const auto out = LensSystem(wide).traceFromFilm({film, DVec3(p, lens.rearZ()) - film});
        if (!out) return std::nullopt;
        return glm::dvec2(out->at((lens.frontZ() - out->o.z) / out->d.z)) - glm::dvec2(front);
      };
      bool solved = true;
      for (int k = 0; k < 6 && solved; ++k) {
        const auto a = misses(rear), b = misses(rear + glm::dvec2(1e-6, 0)),
                   c = misses(rear + glm::dvec2(0, 1e-6));
        solved = a && b && c;
        if (solved) rear -= glm::inverse(glm::dmat2((*b - *a) / 1e-6, (*c - *a) / 1e-6)) * *a;
      }
      if (!solved || !lens.traceFromFilm({film, DVec3(rear, lens.rearZ()) - film})) continue;
      ++passed;
      const PupilBox& b = pupil.box(x);
      EXPECT_TRUE(rear.x >= b.min.x && rear.x <= b.max.x && rear.y >= b.min.y && rear.y <= b.max.y);
    }
    EXPECT_GT(passed, 1000);
  }
}

class RealisticCamera : public testing::Test {
 protected:
  std::unique_ptr<Camera> make(const std::string& lens, std::vector<Parameter> more = {}) {
    // Tests run side by side: each has a file of its own.
    const auto* const test = testing::UnitTest::GetInstance()->current_test_info();
    path_ = testing::TempDir() + "lens-" + test->name() + ".dat";
    std::ofstream(path_) << lens;
    name_[0] = path_;
    Parameter file;
    file.name = "lensfile";
    file.type = ParameterType::String;
    file.strings = name_;
    more.push_back(file);
    return cameraRegistry().get("realistic", {}).create({more, {}}, context_);
  }
  static Parameter number(const char* name, const float& v) {
    Parameter p;
    p.name = name;
    p.floats = {&v, 1};
    return p;
  }
  std::string path_;
  std::string_view name_[1];
  std::vector<std::string> warnings_;
  SourceFiles files_;
  Diagnostics diagnostics_{files_, [this](const std::string& t) { warnings_.push_back(t); }};
  CameraContext context_{
      {diagnostics_, [](const std::string& p) { return p; }, {}}, {}, {200, 100}, 20};
};

TEST_F(RealisticCamera, SeesTheSceneUpright) {
  const float aperture = 4, focus = 2;
  const auto camera =
      make(kSinglet, {number("aperturediameter", aperture), number("focusdistance", focus)});
  EXPECT_TRUE(warnings_.empty());
  const auto target = [&](float x, float y, const Vec2& lens) {
    const CameraRay r = camera->generate({{x, y}, lens, 0});
    EXPECT_GT(r.weight, 0);
    EXPECT_NEAR(length(r.ray.d), 1, 1e-6f);
    return r.ray.at((focus - r.ray.o.z) / r.ray.d.z);
  };
  // In focus whatever the point of the lens.
  for (const Vec2 lens : {Vec2(0.5f), Vec2(0.3f, 0.7f), Vec2(0.8f, 0.5f)})
    EXPECT_LT(length(target(100, 50, lens) - Vec3(0, 0, focus)), 2e-3f);
  // As other cameras have it: x to the right, y of the image downwards.
  EXPECT_GT(target(150, 50, Vec2(0.5f)).x, 0.1f);
  EXPECT_GT(target(100, 20, Vec2(0.5f)).y, 0.05f);
  // The corners of the boxes are outside of the round stop.
  EXPECT_EQ(camera->generate({{100, 50}, {0.01f, 0.01f}, 0}).weight, 0);
}

TEST_F(RealisticCamera, WeightsAreThePupilTimesCos4) {
  const auto simple = make(kSinglet);
  const float centre = simple->generate({{100, 50}, {0.5f, 0.5f}, 0}).weight;
  EXPECT_NEAR(centre, 1, 1e-5f);
  // With a stop that is last, all boxes are alike: cos⁴ of the angle is left.
  const LensSystem lens = [] {
    LensSystem l = singlet(0.0005);
    l.focus(10, 2e-5);
    return l;
  }();
  const double cosine = lens.rearZ() / std::hypot(lens.rearZ(), 0.02 / std::sqrt(5.) * 0.5 * 2);
  const float side = simple->generate({{0, 50}, {0.5f, 0.5f}, 0}).weight;
  EXPECT_NEAR(side, std::pow(cosine, 4), 1e-3);
}

TEST_F(RealisticCamera, DifferentialsAreThoseOfNeighbouringPixels) {
  const auto camera = make(kSinglet);
  const CameraSample at{{60, 30}, {0.45f, 0.55f}, 0};
  const CameraRay r = camera->generate(at);
  ASSERT_GT(r.weight, 0);
  CameraSample right = at, below = at;
  right.film.x += 1;
  below.film.y += 1;
  const CameraRay a = camera->generate(right), b = camera->generate(below);
  EXPECT_LT(length(r.differential.xDirection - a.ray.d), 1e-4f);
  EXPECT_LT(length(r.differential.yDirection - b.ray.d), 1e-4f);
  EXPECT_GT(length(r.differential.xDirection - r.ray.d), 1e-3f);
}

TEST_F(RealisticCamera, FaultsAreSceneErrors) {
  EXPECT_THROW(cameraRegistry().get("realistic", {}).create({{}, {}}, context_), SceneError);
  EXPECT_THROW(make("40 6 1.5"), SceneError);
  const float near = 0.01f, wide = 100;
  EXPECT_THROW(make(kSinglet, {number("focusdistance", near)}), SceneError);
  make(kSinglet, {number("aperturediameter", wide)});
  EXPECT_EQ(warnings_.size(), 1u);
  make("40 6 1.5168 24 -60 30 1 24");
  EXPECT_EQ(warnings_.size(), 2u) << "no stop";
  context_.filmDiagonal = 0;
  EXPECT_THROW(make(kSinglet), SceneError);
}

}  // namespace
}  // namespace lampyris::test
