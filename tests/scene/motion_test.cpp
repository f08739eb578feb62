// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "scene_test.h"

namespace lampyris::test {
namespace {

const std::string kBall = "Shape \"sphere\" \"float radius\" 0.5 ";
/// From x = 0 to x = 4, from time 1 to time 3.
const std::string kMove = "ActiveTransform EndTime Translate 4 0 0 ActiveTransform All ";

std::unique_ptr<RenderJob> build(Reader& r, const std::string& content,
                                 const std::string& options = "TransformTimes 1 3 ") {
  return r.build("Film \"image\" \"integer xresolution\" 8 \"integer yresolution\" 8 " + options +
                 "WorldBegin " + content + " WorldEnd");
}

bool meets(const RenderJob& job, float x, float time, float y = 0) {
  return job.scene.geometry->intersect({{x, y, 9}, {0, 0, -1}, kInfinity, time}).has_value();
}

TEST(Motion, ShapesMoveBetweenTheTransformTimes) {
  Reader r;
  const auto job = build(r, kMove + kBall + kBall + "Translate 0 2 0 " + kBall);
  EXPECT_TRUE(r.warnings.empty());
  for (const float y : {0.f, 2.f}) {
    EXPECT_TRUE(meets(*job, 0, 0, y) && meets(*job, 0, 1, y));
    EXPECT_TRUE(meets(*job, 2, 2, y) && !meets(*job, 0, 2, y) && !meets(*job, 4, 2, y));
    EXPECT_TRUE(meets(*job, 4, 3, y) && meets(*job, 4, 7, y));
  }
  // In the scene's bounds at all times; shapes that move alike are one instance.
  EXPECT_LE(job->scene.bounds.min.x, -0.5f);
  EXPECT_GE(job->scene.bounds.max.x, 4.5f);
  EXPECT_EQ(r.statistics.value("scene", "instances"), 2);
}

TEST(Motion, InstancesMoveAndShapesInThem) {
  Reader r;
  const auto job = build(r, "ObjectBegin \"o\" " + kBall + "AttributeBegin Translate 0 2 0 " +
                                kMove + kBall + "AttributeEnd ObjectEnd ObjectInstance \"o\" " +
                                "Translate 0 0 -30 " + kMove + "ObjectInstance \"o\"");
  const auto depth = [&](float x, float y, float time) {
    const auto hit = job->scene.geometry->intersect({{x, y, 9}, {0, 0, -1}, kInfinity, time});
    return hit ? hit->shape.t : 0;
  };
  EXPECT_NEAR(depth(0, 0, 2), 8.5f, 1e-4f);
  EXPECT_NEAR(depth(2, 2, 2), 8.5f, 1e-4f) << "a moving shape in a still instance";
  EXPECT_NEAR(depth(2, 0, 2), 38.5f, 1e-4f) << "a still shape in a moving instance";
  EXPECT_NEAR(depth(4, 2, 2), 38.5f, 1e-4f) << "both";
  EXPECT_NEAR(depth(8, 2, 3), 38.5f, 1e-4f);
  EXPECT_EQ(depth(8, 2, 2), 0);
}

TEST(Motion, CamerasMove) {
  Reader r;
  const auto job = build(r, kBall,
                         "ActiveTransform EndTime Translate -4 0 0 Rotate 90 0 1 0 ActiveTransform "
                         "All Camera \"perspective\" \"float shutteropen\" 0 \"float "
                         "shutterclose\" 1 ");
  const auto centre = [&](float time) {
    return job->camera->generate({{4, 4}, {0.5f, 0.5f}, time}).ray;
  };
  EXPECT_LT(distance(centre(0).o, Vec3(0)), 1e-6f);
  EXPECT_LT(distance(centre(0).d, {0, 0, 1}), 1e-6f);
  // World to camera: x' = R x − 4, so that the camera stands at R⁻¹ (4, 0, 0).
  const Ray end = centre(kOneMinusEpsilon);
  EXPECT_LT(distance(end.o, {0, 0, 4}), 1e-4f);
  EXPECT_LT(distance(end.d, {-1, 0, 0}), 1e-4f);
  const Ray half = centre(0.5f);
  EXPECT_LT(distance(half.d, {-std::sqrt(0.5f), 0, std::sqrt(0.5f)}), 1e-5f);
  EXPECT_LT(distance(half.o, {0, 0, 2}), 1e-5f);
  EXPECT_TRUE(r.warnings.empty());
}

TEST(Motion, WhatCannotMoveSaysSo) {
  Reader r;
  const auto job = build(r, kMove + "LightSource \"point\" AreaLightSource \"diffuse\" " + kBall);
  ASSERT_EQ(r.warnings.size(), 2u);
  EXPECT_NE(r.warnings[0].find("does not emit"), std::string::npos);
  EXPECT_NE(r.warnings[1].find("this stands where it is at the start time"), std::string::npos);
  EXPECT_EQ(job->scene.lightTable.size(), 1u);
  EXPECT_EQ(parseError("TransformTimes 2 1 WorldBegin WorldEnd"),
            "1:1: TransformTimes expects the earlier time first");
}

}  // namespace
}  // namespace lampyris::test
