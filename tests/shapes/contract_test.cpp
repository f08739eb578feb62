// SPDX-License-Identifier: Apache-2.0
// What every registered shape promises. A shape without a case here fails.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <map>

#include "shapes/ply_writer.h"
#include "shapes/shape_helpers.h"

namespace lampyris::test {
namespace {

const std::vector<Vec3> kTetrahedron = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
const std::vector<int32_t> kTetrahedronIndices = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};

class EveryShape : public testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    const auto mesh = [] {
      return Parameters().integers("indices", kTetrahedronIndices).points("P", kTetrahedron);
    };
    ply_ = (std::filesystem::temp_directory_path() /
            ("lampyris-shape-" + std::to_string(::getpid()) + ".ply"))
               .string();
    TriangleMeshData data;
    data.indices.assign(kTetrahedronIndices.begin(), kTetrahedronIndices.end());
    data.positions = kTetrahedron;
    writePly(ply_, data);
    const std::vector<float> heights{0, 0.3f, 0.1f, 0.5f, 0.2f, 0.4f}, knots{0, 0, 1, 1};
    const std::map<std::string, Parameters> cases = {
        {"trianglemesh", mesh()},
        {"loopsubdiv", mesh().integers("levels", {2})},
        {"plymesh", Parameters().text("filename", ply_)},
        {"heightfield", Parameters().integers("nu", {3}).integers("nv", {2}).floats("Pz", heights)},
        {"nurbs", Parameters()
                      .integers("nu", {2})
                      .integers("nv", {2})
                      .integers("uorder", {2})
                      .integers("vorder", {2})
                      .floats("uknots", knots)
                      .floats("vknots", knots)
                      .points("P", {{0, 0, 0}, {1, 0, 0.2f}, {0, 1, 0.1f}, {1, 1, 0.7f}})},
        {"curve", Parameters()
                      .text("type", "cylinder")
                      .floats("width", {0.2f})
                      .points("P", {{0, 0, 0}, {1, 0, 1}, {2, 1, 0}, {3, 0, 0}})},
        {"sphere", {}},
        {"disk", {}},
        {"cylinder", {}},
        {"cone", {}},
        {"paraboloid", {}},
        {"hyperboloid", {}}};
    const auto found = cases.find(GetParam());
    ASSERT_NE(found, cases.end()) << "give the shape a case";
    const Transform toWorld = Transform::translate({3, -1, 2}) * Transform::scale(Vec3(2)) *
                              Transform::rotate(40, {1, 2, 3});
    shape_ = makeShape(GetParam(), found->second, toWorld);
    for (uint32_t e = 0; e < shape_->elementCount(); ++e) box_.extend(shape_->bounds(e));
  }
  void TearDown() override { std::filesystem::remove(ply_); }

  /// A line through the shape's box.
  Ray ray(uint64_t i) const {
    const auto within = [&](uint32_t d) {
      return box_.min + (box_.max - box_.min) *
                            Vec3(uniform(31, i, d), uniform(31, i, d + 1), uniform(31, i, d + 2));
    };
    const Vec3 a = within(0), d = normalize(within(3) - a);
    return {a - 100.f * d, d};
  }

  std::string ply_;
  std::unique_ptr<Shape> shape_;
  Bounds3 box_;
};

TEST_P(EveryShape, HitsLieOnTheRayAndInTheBounds) {
  const float size = length(box_.max - box_.min);
  size_t hits = 0;
  for (uint64_t i = 0; i < 3000; ++i) {
    const Ray r = ray(i);
    const auto hit = bruteForce(*shape_, r);
    if (!hit) continue;
    ++hits;
    SurfaceInteraction at;
    shape_->surface(hit->element, hit->hit, r, SurfaceDetail::Full, at);
    EXPECT_LT(distance(at.p, r.at(hit->hit.t)), 1e-3f * size);
    const Bounds3 b = shape_->bounds(hit->element);
    for (int a = 0; a < 3; ++a) {
      EXPECT_GE(at.p[a], b.min[a] - 1e-4f * size);
      EXPECT_LE(at.p[a], b.max[a] + 1e-4f * size);
    }
    EXPECT_NEAR(length(at.n), 1, 1e-4f);
    EXPECT_NEAR(length(at.shading.n), 1, 1e-4f);
    const Shape::NormalCone cone = shape_->normalCone(hit->element);
    EXPECT_GE(dot(cone.axis, at.n), cone.cosTheta - 1e-3f);
  }
  EXPECT_GT(hits, 100u);
}

TEST_P(EveryShape, SamplesOfTheAreaAreFoundByRays) {
  std::vector<float> areas;
  double total = 0;
  for (uint32_t e = 0; e < shape_->elementCount(); ++e) {
    areas.push_back(shape_->area(e));
    total += static_cast<double>(areas.back());
  }
  ASSERT_GT(total, 0);
  // Only rays find light of curves.
  if (GetParam() == "curve") {
    EXPECT_FALSE(shape_->sampleSolidAngle(0, box_.min - Vec3(1), {0.5f, 0.5f}));
    return;
  }
  const float size = length(box_.max - box_.min);
  size_t missed = 0, drawn = 0;
  for (uint64_t i = 0; i < 2000; ++i) {
    const auto e = static_cast<uint32_t>(uniform(32, i, 0) * static_cast<float>(areas.size()));
    const auto s = shape_->sampleArea(e, {uniform(32, i, 1), uniform(32, i, 2)});
    ASSERT_EQ(s.has_value(), areas[e] > 0);
    if (!s) continue;
    ++drawn;
    EXPECT_FLOAT_EQ(s->pdf, shape_->pdfArea(e, s->n));
    EXPECT_NEAR(s->pdf * areas[e], 1, 1e-3f);
    // A short ray finds the point again, from its front, and the same side of the surface.
    const float h = 1e-3f * size;
    const auto hit = bruteForce(*shape_, {s->p + h * s->n, -s->n, 2 * h});
    missed += !hit;
    if (!hit) continue;
    EXPECT_NEAR(hit->hit.t, h, 0.1f * h);
    SurfaceInteraction at;
    shape_->surface(hit->element, hit->hit, {s->p + h * s->n, -s->n}, SurfaceDetail::Basic, at);
    EXPECT_GT(dot(at.n, s->n), 0.9f);
  }
  EXPECT_GT(drawn, 1000u);
  EXPECT_LE(missed, drawn / 200);
}

INSTANTIATE_TEST_SUITE_P(Shapes, EveryShape, testing::ValuesIn(shapeRegistry().names()),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace lampyris::test
