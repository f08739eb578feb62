// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <deque>

#include "cameras/registry.h"
#include "core/math.h"
#include "support/statistics.h"

namespace lampyris {
namespace {

class CameraTest : public testing::Test {
 public:
  CameraTest& set(std::string_view name, std::vector<float> values) {
    Parameter p;
    p.name = name;
    p.floats = values_.emplace_back(std::move(values));
    parameters_.push_back(p);
    return *this;
  }

 protected:
  std::unique_ptr<Camera> make(const std::string& name) {
    return cameraRegistry().get(name, {}).create({parameters_, {}}, context_);
  }
  static CameraSample at(float x, float y) { return {{x, y}, {0.5f, 0.5f}, 0}; }
  static void expectNear(const Vec3& a, const Vec3& b, float tolerance = 2e-6f) {
    EXPECT_NEAR(length(a - b), 0, tolerance * std::max(1.f, length(b)))
        << a.x << " " << a.y << " " << a.z;
  }

  std::deque<std::vector<float>> values_;
  std::vector<Parameter> parameters_;
  std::vector<std::string> warnings_;
  SourceFiles files_;
  Diagnostics diagnostics_{files_, [this](const std::string& t) { warnings_.push_back(t); }};
  CameraContext context_{
      {diagnostics_, [](const std::string& p) { return p; }, {}}, {}, {200, 100}, 35};
};

TEST_F(CameraTest, PerspectiveDirections) {
  const auto c = make("perspective");
  const float s = 1 / std::sqrt(2.f);
  expectNear(c->generate(at(100, 50)).ray.d, {0, 0, 1});
  // 90° across the shorter side; y points down in the image.
  expectNear(c->generate(at(100, 0)).ray.d, {0, s, s});
  expectNear(c->generate(at(100, 100)).ray.d, {0, -s, s});
  expectNear(c->generate(at(0, 50)).ray.d, normalize(Vec3(-2, 0, 1)));
  expectNear(c->generate(at(200, 100)).ray.d, normalize(Vec3(2, -1, 1)));
  EXPECT_EQ(c->generate(at(0, 0)).ray.o, Vec3(0));
  EXPECT_EQ(c->generate(at(0, 0)).weight, 1.f);
  EXPECT_EQ(c->generate(at(0, 0)).ray.tMax, kInfinity);
}

TEST_F(CameraTest, PerspectiveOfATallImage) {
  context_.resolution = {100, 200};
  const auto c = make("perspective");
  expectNear(c->generate(at(0, 100)).ray.d, normalize(Vec3(-1, 0, 1)));
  expectNear(c->generate(at(50, 0)).ray.d, normalize(Vec3(0, 2, 1)));
}

TEST_F(CameraTest, FieldOfView) {
  const float t = std::tan(radians(20));
  const Vec3 top = normalize(Vec3(0, t, 1));
  set("fov", {40});
  expectNear(make("perspective")->generate(at(100, 0)).ray.d, top);
  set("fov", {70}).set("halffov", {20});
  expectNear(make("perspective")->generate(at(100, 0)).ray.d, top);
  set("fov", {40}).set("halffov", {-1});
  expectNear(make("perspective")->generate(at(100, 0)).ray.d, top);
}

TEST_F(CameraTest, AspectRatioAndScreenWindow) {
  set("frameaspectratio", {4});
  expectNear(make("perspective")->generate(at(200, 50)).ray.d, normalize(Vec3(4, 0, 1)));
  parameters_.clear();
  set("frameaspectratio", {0.5f});
  expectNear(make("perspective")->generate(at(200, 0)).ray.d, normalize(Vec3(1, 2, 1)));
  set("screenwindow", {-0.5f, 0, 0.25f, 1});
  expectNear(make("perspective")->generate(at(0, 0)).ray.d, normalize(Vec3(-0.5f, 1, 1)));
  expectNear(make("perspective")->generate(at(200, 100)).ray.d, normalize(Vec3(0, 0.25f, 1)));
}

TEST_F(CameraTest, TheTransformApplies) {
  context_.cameraToWorld = Transform::lookAt({1, 2, 3}, {5, 2, 3}, {0, 1, 0}).inverse();
  for (const char* name : {"perspective", "environment"})
    EXPECT_EQ(make(name)->generate(at(10, 20)).ray.o, Vec3(1, 2, 3)) << name;
  expectNear(make("perspective")->generate(at(100, 50)).ray.d, {1, 0, 0});
  expectNear(make("orthographic")->generate(at(100, 50)).ray.o, {1, 2, 3});
  // A scaled camera still has unit directions.
  context_.cameraToWorld = Transform::scale({1e-4f, 1e-4f, 1e-4f});
  EXPECT_NEAR(length(make("perspective")->generate(at(3, 7)).ray.d), 1, 1e-6);
}

TEST_F(CameraTest, Orthographic) {
  const auto c = make("orthographic");
  const CameraRay r = c->generate(at(50, 25));
  expectNear(r.ray.o, {-1, 0.5f, 0});
  EXPECT_EQ(r.ray.d, Vec3(0, 0, 1));
  expectNear(r.differential.xOrigin, {-0.98f, 0.5f, 0});
  expectNear(r.differential.yOrigin, {-1, 0.48f, 0});
  set("screenwindow", {-3, 3, -7, 7});
  expectNear(make("orthographic")->generate(at(0, 0)).ray.o, {-3, 7, 0});
}

TEST_F(CameraTest, Environment) {
  const auto c = make("environment");
  for (const float x : {0.5f, 70.f, 199.5f})
    for (const float y : {0.5f, 33.f, 99.5f}) {
      const float theta = kPi * y / 100, phi = 2 * kPi * x / 200;
      expectNear(c->generate(at(x, y)).ray.d, {std::sin(theta) * std::cos(phi), std::cos(theta),
                                               std::sin(theta) * std::sin(phi)});
    }
}

/// Where a lens of radius 0.2 focused at 3 sends its rays.
TEST_F(CameraTest, LensRaysMeetInTheFocalPlane) {
  set("lensradius", {0.2f}).set("focaldistance", {3});
  for (const char* name : {"perspective", "orthographic"}) {
    const auto c = make(name);
    CameraSample centre = at(30, 80);
    const Vec3 meet =
        std::string(name) == "perspective" ? 3.f * Vec3(-1.4f, -0.6f, 1) : Vec3(-1.4f, -0.6f, 3);
    float farthest = 0;
    for (uint64_t i = 0; i < 500; ++i) {
      centre.lens = {test::uniform(1, i, 0), test::uniform(1, i, 1)};
      const Ray r = c->generate(centre).ray;
      EXPECT_EQ(r.o.z, 0.f);
      EXPECT_LE(length(r.o), 0.2f * (1 + 1e-6f));
      EXPECT_NEAR(length(r.d), 1, 1e-6);
      expectNear(r.at((meet.z - r.o.z) / r.d.z), meet, 1e-5f);
      farthest = std::max(farthest, length(r.o));
    }
    EXPECT_GT(farthest, 0.19f);
  }
}

TEST_F(CameraTest, DifferentialsAreTheRaysOfTheNextPixels) {
  context_.cameraToWorld =
      Transform::lookAt({1, 2, 3}, {-4, 1, 0}, {0, 1, 0.2f}).inverse() * Transform::scale(Vec3(2));
  for (const float lens : {0.f, 0.3f}) {
    parameters_.clear();
    set("lensradius", {lens}).set("focaldistance", {5});
    for (const char* name : {"perspective", "orthographic", "environment"}) {
      const auto c = make(name);
      CameraSample s = at(60.25f, 71.75f);
      s.lens = {0.2f, 0.9f};
      const RayDifferential d = c->generate(s).differential;
      s.film.x += 1;
      const Ray right = c->generate(s).ray;
      s.film += Vec2(-1, 1);
      const Ray down = c->generate(s).ray;
      expectNear(d.xOrigin, right.o, 3e-6f);
      expectNear(d.xDirection, right.d, 3e-6f);
      expectNear(d.yOrigin, down.o, 3e-6f);
      expectNear(d.yDirection, down.d, 3e-6f);
    }
  }
}

TEST_F(CameraTest, Shutter) {
  CameraSample late = at(1, 1);
  late.time = 0.5f;
  EXPECT_EQ(make("perspective")->generate(late).ray.time, 0.5f);
  set("shutteropen", {2}).set("shutterclose", {6});
  for (const char* name : {"perspective", "orthographic", "environment"})
    EXPECT_EQ(make(name)->generate(late).ray.time, 4.f) << name;
  EXPECT_TRUE(warnings_.empty());
  parameters_.clear();
  set("shutteropen", {6}).set("shutterclose", {2});
  late.time = 0;
  EXPECT_EQ(make("perspective")->generate(late).ray.time, 2.f);
  EXPECT_EQ(warnings_.size(), 1u);
}

TEST_F(CameraTest, Errors) {
  const auto expectError = [this](const std::string& camera, std::string_view name,
                                  std::vector<float> values) {
    parameters_.clear();
    set(name, std::move(values));
    EXPECT_THROW(make(camera), SceneError) << name;
  };
  expectError("perspective", "fov", {0});
  expectError("perspective", "fov", {180});
  expectError("perspective", "fov", {-20});
  expectError("perspective", "halffov", {90});
  for (const char* camera : {"perspective", "orthographic"}) {
    expectError(camera, "screenwindow", {-1, 1, 0});
    expectError(camera, "screenwindow", {1, 1, 0, 1});
    expectError(camera, "lensradius", {-1});
    expectError(camera, "focaldistance", {0});
    expectError(camera, "frameaspectratio", {0});
  }
  parameters_.clear();
  for (const std::string& name : cameraRegistry().names()) {
    context_.cameraToWorld = Transform::lookAt({0, 0, 0}, {0, 1, 0}, {0, 1, 0}).inverse();
    EXPECT_THROW(make(name), SceneError) << name;
    context_.cameraToWorld = Transform::scale({1, 0, 1});
    EXPECT_THROW(make(name), SceneError) << name;
  }
}

TEST_F(CameraTest, AnyScaleGivesFiniteRays) {
  for (const float s : {1e-10f, 1e-4f, 1e4f, 1e10f}) {
    parameters_.clear();
    set("lensradius", {s * 0.1f}).set("focaldistance", {s * 3});
    context_.cameraToWorld = Transform::translate(Vec3(s));
    for (const std::string& name : cameraRegistry().names()) {
      if (name == "realistic") continue;  // its lens has a size of its own
      CameraSample sample = at(3, 99);
      sample.lens = {0.1f, 0.7f};
      const CameraRay r = make(name)->generate(sample);
      EXPECT_NEAR(length(r.ray.d), 1, 1e-6) << name << s;
      EXPECT_TRUE(isFinite(r.ray.o) && isFinite(r.differential.xDirection) &&
                  isFinite(r.differential.yOrigin));
    }
  }
}

}  // namespace
}  // namespace lampyris
