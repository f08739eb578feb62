// SPDX-License-Identifier: Apache-2.0
#include "accelerators/light_bvh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <span>

#include "accelerators/wide_light_bvh.h"
#include "core/frame.h"
#include "core/parallel.h"
#include "core/sampling.h"
#include "support/statistics.h"

namespace lampyris::test {
namespace {

float random(uint64_t i, uint32_t d) { return uniform(11, i, d); }
Vec3 randomPoint(uint64_t i, uint32_t d = 0) {
  return {random(i, d), random(i, d + 1), random(i, d + 2)};
}
Vec3 randomDirection(uint64_t i, uint32_t d = 10) {
  return sampleUniformSphere({random(i, d), random(i, d + 1)});
}

enum class Kind { Points, Line, Coincident, Cones, TwoSided, FewCones };
std::vector<LightBVHInput> makeLights(Kind kind, size_t count, float scale = 1) {
  std::vector<LightBVHInput> lights(count);
  for (size_t i = 0; i < count; ++i) {
    LightBounds& b = lights[i].bounds;
    lights[i].id = static_cast<LightId>(i);
    Vec3 p = randomPoint(i) * scale;
    if (kind == Kind::Line) p = Vec3(random(i, 0) * scale, 1, 2);
    if (kind == Kind::Coincident) p = Vec3(1, 2, 3) * scale;
    b.box = Bounds3(p);
    b.intensity = random(i, 4) + 0.01f;
    if (kind == Kind::Points || kind == Kind::Line || kind == Kind::Coincident) continue;
    b.box.extend(p + randomPoint(i, 5) * 0.02f * scale);
    b.axis = kind == Kind::FewCones ? normalize(Vec3(0, 0, 1) + 0.2f * randomDirection(i))
                                    : randomDirection(i);
    b.cosThetaO = std::cos(0.3f * random(i, 8));
    b.cosThetaE = std::cos(0.1f + random(i, 9));
    b.twoSided = kind == Kind::TwoSided;
  }
  return lights;
}

/// Whether light with these bounds, from `source` in its box, can go towards `p`.
bool emitsTo(const LightBounds& b, const Vec3& source, const Vec3& p) {
  const Vec3 w = normalize(p - source);
  float cosine = std::clamp(dot(w, b.axis), -1.f, 1.f);
  if (b.twoSided) cosine = std::abs(cosine);
  return std::acos(cosine) <= std::acos(b.cosThetaO) + std::acos(b.cosThetaE);
}

TEST(LightBVHNode, BoundsWhatWentIn) {
  for (uint64_t i = 0; i < 20'000; ++i) {
    const float scale = std::pow(10.f, 16 * random(i, 20) - 8);
    const Vec3 offset = (randomPoint(i, 30) - 0.5f) * scale * (i % 3 ? 1.f : 1e5f);
    Bounds3 box(offset);
    if (i % 2) box.extend(offset + randomPoint(i) * scale);
    EmissionCone cone;
    cone.axis = randomDirection(i);
    if (i % 7 == 0) cone.axis = Vec3(0, 0, i % 2 ? 1 : -1);
    cone.thetaO = i % 5 ? static_cast<double>(random(i, 3)) * 3.2 : 0;
    cone.thetaE = static_cast<double>(random(i, 4)) * 3.1415;
    cone.twoSided = i % 4 == 0;
    const LinearLightBVHNode n(box, cone, 2.5f, i % 2, 77);
    EXPECT_EQ(n.isLeaf(), i % 2 == 1);
    EXPECT_EQ(n.light(), 77u);
    EXPECT_EQ(n.intensity(), 2.5f);
    EXPECT_EQ(n.twoSided(), cone.twoSided);
    for (int a = 0; a < 3; ++a) {
      EXPECT_LE(static_cast<double>(n.center()[a]) - static_cast<double>(n.halfExtent()[a]),
                static_cast<double>(box.min[a]));
      EXPECT_GE(static_cast<double>(n.center()[a]) + static_cast<double>(n.halfExtent()[a]),
                static_cast<double>(box.max[a]));
      EXPECT_LE(n.halfExtent()[a], 0.51f * box.extent()[a] + 4e-7f * glm::abs(offset)[a]);
    }
    EXPECT_LE(n.cosThetaE(), static_cast<float>(std::cos(cone.thetaE)) + 1e-6f);
    EXPECT_GE(n.cosThetaE(), static_cast<float>(std::cos(cone.thetaE)) - 2e-4f);
    const double thetaO = 2 * std::asin(std::min(static_cast<double>(n.halfSineO()), 1.));
    const Vec3 axis = normalize(n.axis());
    const double off = std::atan2(static_cast<double>(length(cross(axis, cone.axis))),
                                  static_cast<double>(dot(axis, cone.axis)));
    EXPECT_GE(thetaO + 1e-6, std::min(cone.thetaO, 3.14159265) + (n.allNormals() ? 0 : off));
    if (cone.thetaO < 2.5 && !n.allNormals()) {
      EXPECT_LE(thetaO, cone.thetaO + 0.02);
    }
  }
}

TEST(EmissionConeMerge, HoldsBoth) {
  for (uint64_t i = 0; i < 5000; ++i) {
    EmissionCone a, b;
    a.axis = randomDirection(i, 10);
    b.axis = i % 9 == 0 ? -a.axis : (i % 9 == 1 ? a.axis : randomDirection(i, 12));
    a.thetaO = static_cast<double>(random(i, 0)) * (i % 3 ? 1 : 3);
    b.thetaO = i % 4 ? static_cast<double>(random(i, 1)) : 0;
    a.thetaE = 0.2, b.thetaE = 1;
    a.twoSided = i % 5 == 0, b.twoSided = i % 7 == 0;
    const EmissionCone m = merge(a, b);
    EXPECT_EQ(m.thetaE, 1);
    EXPECT_EQ(m.twoSided, a.twoSided || b.twoSided);
    for (const EmissionCone& part : {a, b})
      for (uint64_t k = 0; k < 10; ++k) {
        // A direction on the part's edge, on either side if it has two.
        Vec3 across = normalize(cross(part.axis, randomDirection(i * 10 + k, 40)));
        const double t = part.thetaO;
        Vec3 w =
            static_cast<float>(std::cos(t)) * part.axis + static_cast<float>(std::sin(t)) * across;
        if (part.twoSided && k % 2) w = -w;
        float cosine = std::clamp(dot(w, m.axis), -1.f, 1.f);
        if (m.twoSided) cosine = std::abs(cosine);
        EXPECT_LE(static_cast<double>(std::acos(cosine)), m.thetaO + 1e-3);
      }
  }
}

TEST(EmissionConeMerge, OppositeTwoSidedConesStayNarrow) {
  EmissionCone a, b;
  a.twoSided = b.twoSided = true;
  a.thetaO = b.thetaO = 0.1;
  b.axis = -a.axis;
  EXPECT_NEAR(merge(a, b).thetaO, 0.1, 1e-5);
  a.twoSided = b.twoSided = false;
  EXPECT_NEAR(merge(a, b).thetaO, 0.5 * 3.14159265 + 0.1, 1e-5) << "a cone about a normal to both";
}

void checkStructure(const LightBVHAccel& tree, size_t lights) {
  const auto& nodes = tree.nodes();
  ASSERT_EQ(nodes.size(), 2 * lights - 1);
  size_t leaves = 0;
  for (uint32_t i = 0; i < nodes.size(); ++i) {
    if (nodes[i].isLeaf()) {
      ++leaves;
      EXPECT_EQ(tree.leafOf(nodes[i].light()), i);
      continue;
    }
    const uint32_t right = nodes[i].rightChild();
    ASSERT_GT(right, i + 1);
    ASSERT_LT(right, nodes.size());
    // Cones only widen, and so the intensity of the same flux falls.
    const float sum = nodes[i + 1].intensity() + nodes[right].intensity();
    EXPECT_GT(nodes[i].intensity(), 0);
    EXPECT_LE(nodes[i].intensity(), 1.001f * sum);
    if (nodes[i + 1].allNormals() && nodes[right].allNormals()) {
      EXPECT_NEAR(nodes[i].intensity(), sum, 1e-5f * sum);
    }
  }
  EXPECT_EQ(leaves, lights);
}

using Lights = std::vector<LightBVHInput>;

/// What both forms of the tree promise.
template <class Tree>
class LightTree : public testing::Test {
 protected:
  static Tree build(const Lights& lights) { return Tree(LightBVHAccel(lights)); }
};
using Forms = testing::Types<LightBVHAccel, WideLightBVH>;
TYPED_TEST_SUITE(LightTree, Forms);

TEST(LightBVH, StructureAndDepth) {
  for (const Kind kind : {Kind::Points, Kind::Line, Kind::Coincident, Kind::Cones, Kind::TwoSided})
    for (const size_t count : {size_t{1}, size_t{2}, size_t{3}, size_t{17}, size_t{3000}}) {
      const LightBVHAccel tree(makeLights(kind, count));
      checkStructure(tree, count);
      EXPECT_LE(tree.stats().depth, 4 + 2 * std::log2(static_cast<double>(count)));
      EXPECT_EQ(tree.stats().nodes, tree.nodes().size());
    }
}

TEST(LightBVH, MillionCoincidentLights) {
  const LightBVHAccel tree(makeLights(Kind::Coincident, 1'000'000));
  EXPECT_LE(tree.stats().depth, 21u);
  LightSampleContext ctx;
  ctx.p = Vec3(1, 2, 3);
  EXPECT_FALSE(tree.sample(LightReceiver(ctx), 0.4f))
      << "a point light sends nothing to where it is";
  ctx.p.x = 1.5f;
  const auto s = tree.sample(LightReceiver(ctx), 0.4f);
  ASSERT_TRUE(s);
  EXPECT_EQ(s->pmf, tree.pmf(LightReceiver(ctx), s->light));
}

TEST(LightBVH, GeometricSeriesStaysShallow) {
  // Each split takes one light off; the depth limit ends that.
  std::vector<LightBVHInput> lights(400);
  for (size_t i = 0; i < lights.size(); ++i) {
    lights[i].id = static_cast<LightId>(i);
    lights[i].bounds.box = Bounds3(Vec3(std::pow(0.8f, static_cast<float>(i)), 0, 0));
    lights[i].bounds.intensity = 1;
  }
  EXPECT_LE(LightBVHAccel(lights).stats().depth, 96u);
}

TEST(LightBVH, SplitsLinesAndPlanesInSpace) {
  // Two clusters on a line must not be mixed by the first split.
  std::vector<LightBVHInput> lights(64);
  for (size_t i = 0; i < lights.size(); ++i) {
    lights[i].id = static_cast<LightId>(i);
    lights[i].bounds.box = Bounds3(Vec3(0, (i % 2 ? 100.f : 0.f) + random(i, 0), 0));
    lights[i].bounds.intensity = 1;
  }
  const LightBVHAccel tree(lights);
  const auto& nodes = tree.nodes();
  EXPECT_LT(nodes[1].halfExtent().y, 1);
  EXPECT_LT(nodes[nodes[0].rightChild()].halfExtent().y, 1);
}

TEST(LightBVH, SplitsByOrientation) {
  // Two coincident sheets that face opposite ways along z, a little apart in z, wide in x and y.
  std::vector<LightBVHInput> lights(512);
  for (size_t i = 0; i < lights.size(); ++i) {
    lights[i].id = static_cast<LightId>(i);
    LightBounds& b = lights[i].bounds;
    b.box = Bounds3(Vec3(random(i, 0), random(i, 1), i % 2 ? 0.6f : 0.f));
    b.axis = {0, 0, i % 2 ? 1.f : -1.f};
    b.cosThetaO = 1;
    b.intensity = 1;
  }
  const LightBVHAccel tree(lights);
  EXPECT_LT(tree.nodes()[1].halfSineO(), 0.1f);
}

TEST(LightBVH, SameForAnyNumberOfThreads) {
  for (const Kind kind : {Kind::Points, Kind::Cones}) {
    const auto lights = makeLights(kind, 50'000);
    std::vector<LinearLightBVHNode> one;
    {
      const ThreadLimit limit(1);
      one = LightBVHAccel(lights).nodes();
    }
    const ThreadLimit limit(4);
    const auto four = LightBVHAccel(lights).nodes();
    ASSERT_EQ(one.size(), four.size());
    EXPECT_EQ(std::memcmp(one.data(), four.data(), one.size() * sizeof one[0]), 0);
  }
}

TYPED_TEST(LightTree, DropsLightsThatCannotCount) {
  auto lights = makeLights(Kind::Points, 8);
  lights[1].bounds.intensity = 0;
  lights[2].bounds.intensity = std::nanf("");
  lights[3].bounds.intensity = kInfinity;
  lights[4].bounds.box = Bounds3();
  lights[5].bounds.box = Bounds3(Vec3(std::nanf("")));
  lights[6].bounds.box.max.x = kInfinity;
  const TypeParam tree = TestFixture::build(lights);
  EXPECT_EQ(tree.stats().lights, 2u);
  LightSampleContext ctx;
  for (LightId i = 1; i < 7; ++i) EXPECT_EQ(tree.pmf(LightReceiver(ctx), i), 0);
  EXPECT_NEAR(tree.pmf(LightReceiver(ctx), 0) + tree.pmf(LightReceiver(ctx), 7), 1, 1e-6);
  EXPECT_EQ(tree.pmf(LightReceiver(ctx), kNoLight), 0);
  const TypeParam none = TestFixture::build(Lights(lights.begin() + 1, lights.begin() + 7));
  EXPECT_TRUE(none.empty());
  EXPECT_FALSE(none.sample(LightReceiver(ctx), 0.5f));
  EXPECT_EQ(none.pmf(LightReceiver(ctx), 1), 0);
  EXPECT_EQ(none.rootImportance(LightReceiver(ctx)), 0);
  EXPECT_TRUE(TestFixture::build({}).empty());
}

LightSampleContext makeContext(uint64_t i, const std::vector<LightBVHInput>& lights, float scale) {
  LightSampleContext c;
  c.p = (randomPoint(i, 50) * 1.6f - 0.3f) * scale;
  if (i % 5 == 0) c.p = lights[i % lights.size()].bounds.box.min;
  c.n = randomDirection(i, 60);
  c.ns = normalize(c.n + 0.5f * randomDirection(i, 62));
  c.wo = randomDirection(i, 64);
  c.reflects = i % 3 != 1;
  c.transmits = i % 3 != 0;
  return c;
}

bool permitted(const LightSampleContext& c, const Vec3& w) {
  const bool same = dot(c.n, w) * dot(c.n, c.wo) > 0;
  return same ? c.reflects : c.transmits;
}

TYPED_TEST(LightTree, MissesNoLight) {
  for (const Kind kind : {Kind::Points, Kind::Line, Kind::Cones, Kind::TwoSided, Kind::FewCones})
    for (const float scale : {1e-4f, 1.f, 1e4f}) {
      const auto lights = makeLights(kind, 200, scale);
      const TypeParam tree = TestFixture::build(lights);
      for (uint64_t i = 0; i < 60; ++i) {
        const LightSampleContext c = makeContext(i, lights, scale);
        double sum = 0;
        for (const LightBVHInput& l : lights) {
          const float pmf = tree.pmf(LightReceiver(c), l.id);
          ASSERT_TRUE(pmf >= 0 && pmf <= 1);
          sum += static_cast<double>(pmf);
          const Vec3 e = l.bounds.box.extent();
          const Vec3 source = l.bounds.box.min + randomPoint(i * 1000 + l.id, 70) * e;
          if (source == c.p || !permitted(c, normalize(source - c.p))) continue;
          if (emitsTo(l.bounds, source, c.p)) {
            EXPECT_GT(pmf, 0);
          }
        }
        EXPECT_LE(sum, 1 + 1e-4);
        if (kind == Kind::Points && c.reflects && c.transmits) {
          EXPECT_NEAR(sum, 1, 1e-4);
        }
      }
    }
}

TYPED_TEST(LightTree, DoesNotDependOnTheUnitOfLength) {
  for (const Kind kind : {Kind::Points, Kind::Cones}) {
    // Powers of two, so that rounding is the same.
    const auto lights = makeLights(kind, 300), scaled = makeLights(kind, 300, 4096);
    const TypeParam a = TestFixture::build(lights), b = TestFixture::build(scaled);
    for (uint64_t i = 1; i < 50; ++i) {
      if (i % 5 == 0) continue;
      const auto c = makeContext(i, lights, 1), d = makeContext(i, scaled, 4096);
      for (LightId l = 0; l < 300; ++l)
        EXPECT_NEAR(a.pmf(LightReceiver(c), l), b.pmf(LightReceiver(d), l), 1e-4f);
    }
  }
}

TYPED_TEST(LightTree, ExtremeIntensitiesAndDistances) {
  auto lights = makeLights(Kind::Points, 64);
  for (size_t i = 0; i < lights.size(); ++i) lights[i].bounds.intensity = i % 2 ? 1e12f : 1e-12f;
  const TypeParam tree = TestFixture::build(lights);
  for (const float far : {0.f, 1e-20f, 1e-3f, 1e6f, 1e15f}) {
    LightSampleContext c;
    c.p = lights[3].bounds.box.min + Vec3(far, 0, 0);
    double sum = 0;
    for (LightId l = 0; l < 64; ++l) {
      if (c.p != lights[l].bounds.box.min) {
        EXPECT_GT(tree.pmf(LightReceiver(c), l), 0);
      }
      sum += static_cast<double>(tree.pmf(LightReceiver(c), l));
    }
    EXPECT_NEAR(sum, 1, 1e-5);
    EXPECT_TRUE(std::isfinite(tree.rootImportance(LightReceiver(c))));
  }
}

TYPED_TEST(LightTree, DrawsAsPmfSays) {
  const auto lights = makeLights(Kind::Cones, 400);
  const TypeParam tree = TestFixture::build(lights);
  for (uint64_t i = 0; i < 6; ++i) {
    const LightSampleContext c = makeContext(i, lights, 1);
    std::vector<double> observed(401, 0.), expected(401, 0.);
    const int n = 40'000;
    expected[400] = n;
    for (LightId l = 0; l < 400; ++l) {
      expected[l] = n * static_cast<double>(tree.pmf(LightReceiver(c), l));
      expected[400] -= expected[l];
    }
    expected[400] = std::max(expected[400], 0.);
    for (int k = 0; k < n; ++k) {
      const auto s = tree.sample(LightReceiver(c), uniform(77, static_cast<uint64_t>(k), 3));
      ++observed[s ? s->light : 400];
      if (s) {
        ASSERT_EQ(s->pmf, tree.pmf(LightReceiver(c), s->light));
      }
    }
    EXPECT_EQ(chiSquareTest(observed, expected), "");
  }
}

TYPED_TEST(LightTree, DrawsEveryLightOfALargeTree) {
  const auto lights = makeLights(Kind::Coincident, 1 << 20);
  const TypeParam tree = TestFixture::build(lights);
  LightSampleContext c;
  c.p = Vec3(5);
  const size_t cells = 64;
  const int n = 100'000;
  std::vector<double> observed(cells, 0.), exact(cells, 0.);
  double total = 0;
  for (const auto& l : lights) total += static_cast<double>(l.bounds.intensity);
  for (const auto& l : lights)
    exact[l.id % cells] += static_cast<double>(l.bounds.intensity) / total * n;
  for (int k = 0; k < n; ++k) {
    const auto s = tree.sample(LightReceiver(c), uniform(78, static_cast<uint64_t>(k), 3));
    ASSERT_TRUE(s);
    ++observed[s->light % cells];
  }
  EXPECT_EQ(chiSquareTest(observed, exact), "");
}

/// Emission factors are means: over all directions they give the flux that went in.
TEST(LightBVH, ClustersKeepTheirFlux) {
  for (const float spread : {0.1f, 0.6f, 3.f})
    for (const bool twoSided : {false, true}) {
      Lights lights(400);
      for (size_t i = 0; i < lights.size(); ++i) {
        lights[i].id = static_cast<LightId>(i);
        LightBounds& b = lights[i].bounds;
        b.box = Bounds3(Vec3(0));
        b.axis = normalize(Vec3(0, 0, 1) + spread * randomDirection(i));
        b.cosThetaO = 1;
        b.twoSided = twoSided;
        b.intensity = 1;
      }
      const LightBVHAccel tree(lights);
      const int n = 4000;
      double mean = 0;
      for (int k = 0; k < n; ++k) {
        const Vec3 from = sampleUniformSphere(
            {uniform(3, static_cast<uint64_t>(k), 0), uniform(3, static_cast<uint64_t>(k), 1)});
        mean += LightReceiver(from * 100.f, 0).importance(tree.nodes()[0]) * 1e4 / n;
      }
      // A flat emitter's mean over all directions is a quarter of its peak.
      const double expected = 400 * (twoSided ? 0.5 : 0.25);
      EXPECT_NEAR(mean, expected, 0.2 * expected) << spread << ' ' << twoSided;
    }
}

TEST(LightBVH, MeanCosine) {
  for (const float thetaB : {0.05f, 0.5f, 1.f, 1.57f})
    for (const float theta : {0.f, 0.7f, 1.4f, 1.9f, 2.8f}) {
      // Directions within thetaB of one that makes the angle theta with the normal.
      const Frame frame = Frame::fromZ({std::sin(theta), 0, std::cos(theta)});
      const int n = 20'000;
      double clamped = 0, absolute = 0;
      for (int k = 0; k < n; ++k) {
        const auto i = static_cast<uint64_t>(k);
        const float z = 1 - uniform(4, i, 0) * (1 - std::cos(thetaB)),
                    phi = 2 * kPi * uniform(4, i, 1);
        const float r = std::sqrt(1 - z * z);
        const float cosine = frame.toWorld({r * std::cos(phi), r * std::sin(phi), z}).z;
        clamped += static_cast<double>(std::max(0.f, cosine)) / n;
        absolute += static_cast<double>(std::abs(cosine)) / n;
      }
      const float m = capMean(std::cos(thetaB));
      EXPECT_NEAR(static_cast<double>(meanCosine(std::cos(theta), m)), clamped, 0.1);
      EXPECT_NEAR(static_cast<double>(meanAbsCosine(std::cos(theta), m)), absolute, 0.17);
    }
}

TEST(LightBVH, ByIntensity) {
  const auto lights = makeLights(Kind::Points, 100);
  const LightBVHAccel tree(lights);
  double total = 0;
  for (const auto& l : lights) total += static_cast<double>(l.bounds.intensity);
  for (const auto& l : lights)
    EXPECT_NEAR(static_cast<double>(tree.pmfByIntensity(0, tree.leafOf(l.id))),
                static_cast<double>(l.bounds.intensity) / total, 1e-6);
  for (int k = 0; k < 100; ++k) {
    const SampledLight s = tree.sampleByIntensity(0, (k + 0.5) / 100);
    EXPECT_EQ(s.pmf, tree.pmfByIntensity(0, tree.leafOf(s.light)));
  }
}

}  // namespace
}  // namespace lampyris::test
