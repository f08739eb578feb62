// SPDX-License-Identifier: Apache-2.0
/// Faults of other light trees, one test each, named after the fault, for both forms of ours.
#include "core/parallel.h"
#include "light_trees.h"

namespace lampyris::test {
namespace {

template <class Tree>
class LightTreeFault : public LightTree<Tree> {};
TYPED_TEST_SUITE(LightTreeFault, LightTreeForms);

/// Sum of the pmf of the lights whose id is even.
double evenShare(const std::vector<double>& pmf) {
  double sum = 0;
  for (size_t l = 0; l < pmf.size(); l += 2) sum += pmf[l];
  return sum;
}

// pbrt-v4: d² is at least half the length of a diagonal.
TYPED_TEST(LightTreeFault, ClampThatDependsOnTheUnitOfLength) {
  for (const Kind kind : {Kind::Points, Kind::Cones, Kind::TwoSided})
    for (const float scale : {0x1p-13f, 0x1p13f}) {  // powers of two, so that rounding is the same
      const auto lights = makeLights(kind, 300), scaled = makeLights(kind, 300, scale);
      const TypeParam a = TestFixture::build(lights), b = TestFixture::build(scaled);
      for (uint64_t i = 1; i < 50; ++i) {
        if (i % 5 == 0) continue;
        const auto c = makeContext(i, lights, 1), d = makeContext(i, scaled, scale);
        const auto one = pmfs(a, c, 300), other = pmfs(b, d, 300);
        for (size_t l = 0; l < 300; ++l)
          ASSERT_NEAR(one[l], other[l], 1e-3 * one[l] + 1e-9) << scale << ' ' << i << ' ' << l;
      }
    }
}

// pbrt-v4: the way to a light is a trail of 32 bits. Falcor: 64 bits.
TYPED_TEST(LightTreeFault, BitTrailTooShortForDeepTrees) {
  // Each split takes one light off: the rest is near its origin and weak.
  std::vector<Vec3> positions(150);
  for (size_t i = 0; i < positions.size(); ++i)
    positions[i] = {std::pow(0.6f, static_cast<float>(i)), 0, 0};
  Lights lights = pointLights(positions);
  for (LightBVHInput& l : lights) l.bounds.intensity = std::sqrt(l.bounds.box.min.x);
  ASSERT_GT(LightBVHAccel(lights).stats().depth, 64u);
  ASSERT_LE(LightBVHAccel(lights).stats().depth, 96u);
  const TypeParam tree = TestFixture::build(lights);
  int drawnBelow = 0;
  for (LightId l = 0; l < lights.size(); l += 7) {
    const LightSampleContext c = volumeAt(positions[l] * Vec3(1, 0, 0) * 1.01f);
    const auto pmf = pmfs(tree, c, lights.size());
    EXPECT_NEAR(sumOf(pmf), 1, 1e-4);
    std::vector<double> drawn(lights.size(), 0.);
    for (int k = 0; k < 500; ++k) {
      const auto s = tree.sample(LightReceiver(c), (k + 0.5) / 500);
      ASSERT_TRUE(s);
      ASSERT_EQ(static_cast<double>(s->pmf), pmf[s->light]);
      ++drawn[s->light];
      drawnBelow += s->light > 64;
    }
    // A light has an interval of the variates.
    for (size_t i = 0; i < pmf.size(); ++i) EXPECT_NEAR(drawn[i], 500 * pmf[i], 1.01);
  }
  EXPECT_GT(drawnBelow, 1000);
}

// pbrt-v4: boxes without area cost nothing, so no split of them is found. The thesis's program:
// their cost isn't a number.
TYPED_TEST(LightTreeFault, BoxesWithoutAreaAreNeverSplit) {
  // Two clusters, whose lights alternate.
  for (const Vec3 along : {Vec3(1, 0, 0), Vec3(0, 1, 0), Vec3(0, 0, 1), Vec3(1, 1, 1)})
    for (const Vec3 across : {Vec3(0), Vec3(along.y, along.z, along.x)}) {
      std::vector<Vec3> positions(256);
      for (size_t i = 0; i < positions.size(); ++i)
        positions[i] = along * ((i % 2 ? 100.f : 0.f) + random(i, 0)) + across * random(i, 1);
      const TypeParam tree = TestFixture::build(pointLights(positions));
      for (const float at : {-1.f, 2.f}) {
        // The others are 50 times as far.
        const auto pmf = pmfs(tree, volumeAt(along * at + across), positions.size());
        EXPECT_NEAR(sumOf(pmf), 1, 1e-4);
        EXPECT_GT(evenShare(pmf), 0.99);
      }
    }
}

// pbrt-v4: the union of two opposite cones is the whole sphere.
TYPED_TEST(LightTreeFault, OppositeConesBecomeTheWholeSphere) {
  Lights lights;
  for (LightId i = 0; i < 128; ++i) {
    if (i % 2 == 0) {
      lights.push_back(flatLight(i, randomPoint(i) * 0.1f, {0, 0, i % 4 ? 1.f : -1.f}, 0.5f));
      lights.back().bounds.twoSided = true;
    } else {
      lights.push_back(pointLights({Vec3(5, 0, 0) + randomPoint(i)})[0]);
      lights.back().id = i;
    }
  }
  const TypeParam tree = TestFixture::build(lights);
  // Where none of the cones of 60° reaches, no draw is lost in their cluster.
  for (uint64_t k = 0; k < 20; ++k) {
    const float phi = 2 * kPi * random(k, 80);
    const auto pmf = pmfs(tree, volumeAt({3 * std::cos(phi), 3 * std::sin(phi), 0.05f}), 128);
    EXPECT_EQ(evenShare(pmf), 0);
    EXPECT_NEAR(sumOf(pmf), 1, 1e-4);
  }
}

// pbrt-v4: by |n·ω|, lights behind an opaque surface weigh as much as those in front of it.
TYPED_TEST(LightTreeFault, FullWeightBehindAnOpaqueSurface) {
  std::vector<Vec3> positions(512);
  for (size_t i = 0; i < positions.size(); ++i)
    positions[i] = randomPoint(i) * Vec3(1, 1, i % 2 ? -1 : 1) + Vec3(0, 0, i % 2 ? -0.05f : 0.05f);
  const TypeParam tree = TestFixture::build(pointLights(positions));
  for (uint64_t k = 0; k < 20; ++k) {
    LightSampleContext c = opaqueAt({random(k, 80), random(k, 81), 0}, {0, 0, 1});
    const auto front = pmfs(tree, c, positions.size());
    EXPECT_EQ(sumOf(front) - evenShare(front), 0);
    EXPECT_GT(evenShare(front), 0.97);
    c.wo = -c.wo;
    EXPECT_EQ(evenShare(pmfs(tree, c, positions.size())), 0) << "seen from behind";
    c.reflects = false, c.transmits = true;
    EXPECT_GT(evenShare(pmfs(tree, c, positions.size())), 0.97) << "light from behind only";
  }
}

// pbrt-v4: the weight of a point light or a spot is its power, that of an emitter is too, though it
// belongs to another solid angle; so what looks the same is drawn four times as often.
TYPED_TEST(LightTreeFault, WeightsOfDifferentUnits) {
  const Vec3 at(0, 0, 1), down(0, 0, -1);
  Lights kinds = {flatLight(1, {0, 0, 2}, down), flatLight(1, {0, 0, 2}, down),
                  flatLight(1, {0, 0, 2}, down, 0.9f)};  // the last one: a spot of 26°
  kinds[1].bounds.twoSided = true;
  for (const LightBVHInput& other : kinds) {
    const TypeParam tree = TestFixture::build({pointLights({Vec3(0)})[0], other});
    EXPECT_NEAR(tree.pmf(LightReceiver(volumeAt(at)), 0), 0.5, 0.01);
    EXPECT_NEAR(tree.pmf(LightReceiver(volumeAt(at)), 1), 0.5, 0.01);
  }
}

// pbrt-v4: where all importances are 0, so is the denominator of the pmf.
TYPED_TEST(LightTreeFault, ZeroOverZero) {
  Lights away, coincident = pointLights(std::vector<Vec3>(64, Vec3(1, 2, 3)));
  for (LightId i = 0; i < 64; ++i) away.push_back(flatLight(i, randomPoint(i), {0, 0, 1}, 0.3f));
  LightSampleContext nothing = volumeAt(Vec3(0));
  nothing.reflects = nothing.transmits = false;
  for (const auto& [lights, at] : {std::pair{away, volumeAt({0.5f, 0.5f, -3})},
                                   {away, opaqueAt({0.5f, 0.5f, 5}, {0, 0, 1})},
                                   {coincident, nothing}}) {
    const TypeParam tree = TestFixture::build(lights);
    EXPECT_FALSE(tree.sample(LightReceiver(at), 0.4));
    for (const double p : pmfs(tree, at, 64)) EXPECT_EQ(p, 0);
  }
  // What a draw costs where all lights are at the point itself is nobody's concern.
  const auto at = volumeAt({1, 2, 3});
  for (const double p : pmfs(TestFixture::build(coincident), at, 64)) EXPECT_TRUE(p >= 0 && p <= 1);
}

// The thesis's program and Cycles: the angle factor weighs down lights that face away, but never
// rules them out.
TYPED_TEST(LightTreeFault, AngleFactorNeverCulls) {
  Lights lights;
  const Vec3 at(0.5f, 0.5f, 4);
  for (LightId i = 0; i < 512; ++i) {
    const Vec3 p = randomPoint(i);
    const Vec3 w = normalize(normalize(at - p) + 0.3f * randomDirection(i));
    lights.push_back(flatLight(i, p, i % 2 ? -w : w, i % 4 < 2 ? 0 : 0.7f));
  }
  const TypeParam tree = TestFixture::build(lights);
  const auto pmf = pmfs(tree, volumeAt(at), lights.size());
  EXPECT_EQ(sumOf(pmf) - evenShare(pmf), 0);
  EXPECT_GT(evenShare(pmf), 0.5);
}

// Falcor: all lights of a leaf are equally likely.
TYPED_TEST(LightTreeFault, UniformChoiceInTheLeaf) {
  Lights lights = pointLights(std::vector<Vec3>(8, Vec3(0)));
  double total = 0;
  for (LightId i = 0; i < 8; ++i) {
    lights[i].bounds.intensity = std::pow(4.f, static_cast<float>(i));
    total += static_cast<double>(lights[i].bounds.intensity);
  }
  const auto pmf = pmfs(TestFixture::build(lights), volumeAt({0, 0, 1}), 8);
  for (LightId i = 0; i < 8; ++i) {
    const double share = static_cast<double>(lights[i].bounds.intensity) / total;
    EXPECT_NEAR(pmf[i], share, 0.01 * share);
  }
}

// Cycles: half of the mass takes no notice of distance, in volumes in particular.
TYPED_TEST(LightTreeFault, HalfOfTheMassIsUniformInVolumes) {
  // Two equal clusters, one of them ten times as far as the other.
  std::vector<Vec3> positions(512);
  for (size_t i = 0; i < positions.size(); ++i)
    positions[i] = randomDirection(i) * 0.1f + Vec3(i % 2 ? 10.f : 1.f, 0, 0);
  const TypeParam tree = TestFixture::build(pointLights(positions));
  const auto pmf = pmfs(tree, volumeAt(Vec3(0)), positions.size());
  EXPECT_NEAR(1 - evenShare(pmf), 0.01, 0.003);
}

// The thesis's program: all threads share one generator of random numbers.
TYPED_TEST(LightTreeFault, OneGeneratorForAllThreads) {
  const Lights lights = makeLights(Kind::Cones, 1000);
  const TypeParam tree = TestFixture::build(lights);
  const size_t n = 4000;
  const auto drawn = [&](int threads) {
    const ThreadLimit limit(threads);
    std::vector<LightId> ids(n);
    parallelFor(n, 16, [&](size_t begin, size_t end) {
      for (size_t i = begin; i < end; ++i) {
        const auto s = tree.sample(LightReceiver(makeContext(i % 7, lights, 1)), random(i, 90));
        ids[i] = s ? s->light : kNoLight;
      }
    });
    return ids;
  };
  EXPECT_EQ(drawn(1), drawn(4));
}

// The thesis, §4.7: light that comes through a surface is drawn as if it couldn't, so the few
// times that it is, its weight is a bright dot.
TYPED_TEST(LightTreeFault, BrightDotsBehindGlass) {
  for (const Kind kind : {Kind::Points, Kind::TwoSided}) {
    Lights lights = makeLights(kind, 500);
    // On either side of the points, far enough that clusters don't hide what is near.
    for (LightBVHInput& l : lights) {
      const Vec3 shift(0, 0, l.id % 2 ? 1 : -2);
      l.bounds.box = Bounds3(l.bounds.box.min + shift, l.bounds.box.max + shift);
    }
    const TypeParam tree = TestFixture::build(lights);
    for (uint64_t i = 0; i < 90; ++i) {
      LightSampleContext c = opaqueAt(randomPoint(i, 50) * Vec3(1, 1, 0), randomDirection(i, 60));
      c.ns = normalize(c.n + 0.5f * randomDirection(i, 62));
      // Glass, what only transmits, and what only reflects.
      c.transmits = i % 3 != 2;
      c.reflects = i % 3 != 1;
      const auto pmf = pmfs(tree, c, lights.size());
      double sum = 0, largest = 0;
      for (size_t l = 0; l < lights.size(); ++l) {
        const LightBounds& b = lights[l].bounds;
        const Vec3 d = b.box.centroid() - c.p;
        if (!permitted(c, d) || !emitsTo(b, b.box.centroid(), c.p)) continue;
        const Vec3 w = normalize(d);
        double e = static_cast<double>(b.intensity * absDot(c.ns, w) / dot(d, d));
        if (kind == Kind::TwoSided) e *= static_cast<double>(absDot(w, b.axis));
        sum += e;
        ASSERT_GT(pmf[l], 0);
        largest = std::max(largest, e / pmf[l]);
      }
      // Each of the binary tree's many choices adds to what is overestimated.
      const double bound = std::is_same_v<TypeParam, WideLightBVH> ? 40 : 200;
      EXPECT_LT(largest, bound * sum) << i;
    }
  }
}

}  // namespace
}  // namespace lampyris::test
