// SPDX-License-Identifier: Apache-2.0
#include "guiding/significance_cache.h"

#include <gtest/gtest.h>

#include "core/frame.h"
#include "core/parallel.h"
#include "core/sampling.h"
#include "function_weight.h"
#include "support/statistics.h"

namespace lampyris::test {

namespace {

const Bounds3 kUnitBox(Vec3(0), Vec3(1));

/// `says`: whether it tells that it is even.
FunctionWeight Even(const Vec3& n, bool says = false) {
  return FunctionWeight(
      [n](const Vec3& wi) { return 0.3f * (n == Vec3(0) ? 1 : std::max(0.f, dot(wi, n))); },
      says ? 0.3f : -1.f);
}

/// A sample at a point of a plane with normal `n` (0: of a box), by a direction that is uniform
/// over the sphere above; without radiance.
GuideSample darkSample(const Vec3& n, uint64_t a, uint64_t b) {
  const auto u = [&](uint32_t d) { return uniform(a, b, d); };
  GuideSample s;
  s.p = Vec3(u(0), u(1), n == Vec3(0) ? u(2) : 0.5f);
  s.n = n;
  s.wi = sampleUniformSphere({u(3), u(4)});
  s.pdf = 1 / (4 * kPi);
  if (n != Vec3(0) && dot(s.wi, n) < 0) s.wi = -s.wi;
  if (n != Vec3(0)) s.pdf *= 2;
  return s;
}

/// Teaches a cache the radiance `light(w)` at random points of a plane with normal `n` (0: of a
/// box), by directions that are uniform over the sphere above.
void teach(SignificanceCache& cache, const Vec3& n, float (*light)(const Vec3&), uint64_t passes,
           int count = 4000) {
  for (uint64_t pass = 0; pass < passes; ++pass) {
    std::vector<GuideSample> samples;
    for (int i = 0; i < count; ++i) {
      GuideSample& s = samples.emplace_back(darkSample(n, pass + 1, static_cast<uint64_t>(i)));
      s.radiance = light(s.wi);
    }
    cache.learn(samples);
    cache.endPass();
  }
}

const Vec3 kUp(0, 0, 1);
const Vec3 kLow = normalize(Vec3(1, 0.3f, 0.2f)), kHigh = normalize(Vec3(-0.3f, 0.2f, 1));

float twoPatches(const Vec3& w) {
  return (dot(w, kLow) > 0.98f ? 30.f : 0.f) + (dot(w, kHigh) > 0.9f ? 10.f : 0.f);
}

/// Empty if the guide's directions are distributed as it says.
std::string compareDrawsWithPdf(const LocalGuide& local) {
  uint64_t draws = 0;
  DirectionTest test;
  test.samples = 100'000;
  test.subdivisions = 24;
  test.sample = [&](const Vec2& u, float uc, Vec3& w) {
    NumberSequence more(++draws);
    w = local.sample(uc, u, more);
    return true;
  };
  test.pdf = [&](const Vec3& w) { return static_cast<double>(local.pdf(w)); };
  return directionChiSquareTest(test);
}

TEST(SignificanceCache, FindsWhatItWasTaught) {
  SignificanceCache cache({0.6f, 8, 1000}, kUnitBox);
  teach(cache, kUp, twoPatches, 6);
  const auto local = cache.makeLocal();
  ASSERT_TRUE(local->moveTo({Vec3(0.5f), kUp, false}, Even(kUp)));
  // Of both patches, and far more than elsewhere.
  EXPECT_GT(local->pdf(kLow), 1.f);
  EXPECT_GT(local->pdf(kHigh), 1.f);
  EXPECT_LT(local->pdf(normalize(Vec3(0, -1, 0.5f))), 0.02f);
  // Surfaces that face another way, and media, know nothing of it.
  EXPECT_FALSE(local->moveTo({Vec3(0.5f), -kUp, false}, Even(-kUp)));
  EXPECT_FALSE(local->moveTo({Vec3(0.5f), Vec3(0), false}, Even(Vec3(0))));
}

TEST(SignificanceCache, StartsFromPhotons) {
  // Light from one direction with the flux 1 on a plane.
  constexpr int kCount = 40'000;
  std::vector<GuidePhoton> photons;
  for (int i = 0; i < kCount; ++i) {
    const auto u = [i](uint32_t d) { return uniform(9, static_cast<uint64_t>(i), d); };
    photons.push_back({Vec3(u(0), u(1), 0.5f), kHigh, kHigh.z / kCount, kUp});
  }
  SignificanceCache cache({0.6f, 8, 100'000}, kUnitBox);
  cache.seed(photons);
  float flux = 0;
  for (const auto& lobe : cache.find(Vec3(0.4f, 0.6f, 0.5f), kUp).lobes) {
    EXPECT_GT(dot(lobe.axis.direction, kHigh), 0.99f);
    flux += lobe.flux;
  }
  EXPECT_NEAR(flux, 1, 0.4f);
}

/// Photons that all come from (or, without the sign, have all met in) one point.
void seedFromPoint(SignificanceCache& cache, const Vec3& point, float sign, int count) {
  std::vector<GuidePhoton> photons;
  for (int i = 0; i < count; ++i) {
    const auto u = [i](uint32_t d) { return uniform(5, static_cast<uint64_t>(i), d); };
    const Vec3 p(u(0), u(1), 0.5f);
    photons.push_back({p, sign * normalize(point - p), 1.f / static_cast<float>(count), kUp});
  }
  cache.seed(photons);
}

TEST(SignificanceCache, DimPartsOfSeededCellsKnowTheirOwnLight) {
  // Bright light from one side beside dim light from the other: what the whole knows must not
  // outshine what a part's own photons tell.
  std::vector<GuidePhoton> photons;
  for (int i = 0; i < 20'000; ++i) {
    const auto u = [i](uint32_t d) { return uniform(7, static_cast<uint64_t>(i), d); };
    const bool dim = i % 200 == 0;
    photons.push_back(
        {Vec3(0.5f * (u(0) + static_cast<float>(dim)), u(1), 0.5f), dim ? kLow : kHigh, 1, kUp});
  }
  SignificanceCache cache({0.6f, 8, 100'000}, kUnitBox);
  cache.seed(photons);
  for (const float x : {0.7f, 0.9f}) {
    float own = 0, others = 0;
    for (const auto& lobe : cache.find(Vec3(x, 0.4f, 0.5f), kUp).lobes)
      (dot(lobe.axis.direction, kLow) > 0.97f ? own : others) += lobe.flux;
    EXPECT_GT(own, 2 * others) << x;
  }
}

TEST(SignificanceCache, HoldsMoreRecordsWhereTheyAreNarrow) {
  // Light from many small patches, or from everywhere.
  static float edge;
  const auto patches = [](const Vec3& w) {
    for (uint64_t i = 0; i < 24; ++i) {
      const Vec3 centre = sampleUniformSphere({uniform(3, i, 0) / 2, uniform(3, i, 1)});
      if (dot(w, centre) > edge) return 1.f;
    }
    return 0.f;
  };
  const auto count = [&](float e) {
    edge = e;
    SignificanceCache cache({1, 4, 1000}, kUnitBox);
    teach(cache, kUp, patches, 6, 20'000);
    return cache.find(Vec3(0.5f), kUp).lobes.size();
  };
  EXPECT_GT(count(0.995f), 4u);
  EXPECT_LE(count(0.995f), 8u);
  EXPECT_LE(count(-1), 4u);
}

TEST(SignificanceCache, LobesTurnTowardsWhatIsNear) {
  const Vec3 lamp(0.4f, 0.6f, 1.2f), image(0.4f, 0.6f, 0.f);
  for (const float sign : {1.f, -1.f}) {
    const Vec3& point = sign > 0 ? lamp : image;
    SignificanceCache cache({0.6f, 8, 100'000}, kUnitBox);
    seedFromPoint(cache, point, sign, 400);  // few: cells are wide
    float worst = 1;
    for (uint64_t i = 0; i < 200; ++i) {
      const Vec3 p(uniform(1, i, 0), uniform(1, i, 1), 0.5f);
      const SignificanceCache::Lobe* best = nullptr;
      const SignificanceCache::Lobes found = cache.find(p, kUp);
      for (const auto& lobe : found.lobes)
        if (!best || lobe.flux > best->flux) best = &lobe;
      ASSERT_TRUE(best);
      worst = std::min(worst, dot(best->axis.at(p), sign * normalize(point - p)));
    }
    EXPECT_GT(worst, 0.98f) << sign;
  }
}

TEST(SignificanceCache, TurnedLobesAreSampledByTheirPdf) {
  SignificanceCache cache({0.6f, 8, 100'000}, kUnitBox);
  seedFromPoint(cache, Vec3(0.4f, 0.6f, 0.8f), 1, 400);
  const auto local = cache.makeLocal();
  for (const bool says : {false, true}) {
    ASSERT_TRUE(local->moveTo({Vec3(0.9f, 0.3f, 0.5f), kUp, false}, Even(kUp, says)));
    EXPECT_EQ(compareDrawsWithPdf(*local), "") << says;
  }
}

TEST(SignificanceCache, RemembersPhotonsWherePathsFindNothing) {
  SignificanceCache cache({0.6f, 8, 100'000}, kUnitBox);
  seedFromPoint(cache, Vec3(0.4f, 0.6f, 1000), 1, 2000);
  const Vec3 p(0.5f);
  const auto flux = [&] {
    float sum = 0;
    for (const auto& lobe : cache.find(p, kUp).lobes) {
      EXPECT_GT(lobeExponent(lobe.level), 1000u);
      sum += lobe.flux;
    }
    return sum;
  };
  const float before = flux();
  for (uint64_t pass = 0; pass < 8; ++pass) {
    std::vector<GuideSample> dark;
    for (uint64_t i = 0; i < 5000; ++i) dark.push_back(darkSample(kUp, pass, i));
    cache.learn(dark);
    cache.endPass();
  }
  // 40,000 dark samples beside 2,000 photons that count like twenty each, and a part of which each
  // cell looks at.
  EXPECT_GT(flux() / before, 0.4f);
  EXPECT_LT(flux() / before, 0.8f);
}

TEST(SignificanceCache, ExponentsFitTheLight) {
  // A patch of cos > c: mean cosine (1 + c)/2 = (e + 1)/(e + 2).
  for (const float c : {0.5f, 0.9f, 0.98f}) {
    static float edge;
    edge = c;
    SignificanceCache cache({1, 4, 1000}, kUnitBox);
    teach(
        cache, kUp, [](const Vec3& w) { return w.z > edge ? 1.f : 0.f; }, 6, 20'000);
    const auto lobes = cache.find(Vec3(0.5f), kUp).lobes;
    ASSERT_FALSE(lobes.empty());
    float flux = 0, cosines = 0;
    for (const auto& l : lobes) {
      const auto n = static_cast<float>(lobeExponent(l.level));
      flux += l.flux;
      cosines += l.flux * l.axis.direction.z * (n + 1) / (n + 2);
    }
    EXPECT_NEAR(flux, 2 * kPi * (1 - c), 0.15f * flux) << c;
    // Levels round the exponent up by half at most.
    EXPECT_NEAR(1 - cosines / flux, (1 - c) / 2, 0.4f * (1 - c) / 2) << c;
  }
}

TEST(SignificanceCache, MixtureSamplingMatchesItsPdf) {
  for (const bool volume : {false, true})
    for (const bool transmits : {false, true}) {
      const Vec3 n = volume ? Vec3(0) : kUp;
      SignificanceCache cache({0.6f, 8, 1000}, kUnitBox);
      teach(cache, n, twoPatches, 4);
      if (transmits)
        teach(
            cache, -n, [](const Vec3& w) { return w.x > 0.5f ? 1.f : 0.1f; }, 4);
      const auto local = cache.makeLocal();
      const FunctionWeight both([](const Vec3& wi) { return 0.1f + std::abs(wi.z); });
      ASSERT_TRUE(local->moveTo({Vec3(0.4f), n, transmits}, both));
      EXPECT_EQ(compareDrawsWithPdf(*local), "") << volume << transmits;
    }
}

TEST(SignificanceCache, WhatCellsHoldReadyIsWhatPointsWouldFind) {
  const Vec3 tilted = normalize(Vec3(0.02f, -0.01f, 1));  // another plane than the cell's
  for (const Vec3& learned : {kUp, Vec3(0)})
    for (const Vec3& n : {learned, learned == Vec3(0) ? learned : tilted}) {
      SignificanceCache cache({0.6f, 8, 1000}, kUnitBox);
      teach(cache, learned, twoPatches, 4);
      const auto ready = cache.makeLocal(), found = cache.makeLocal();
      ASSERT_TRUE(ready->moveTo({Vec3(0.4f), n, false}, Even(n, true)));
      ASSERT_TRUE(found->moveTo({Vec3(0.4f), n, false}, Even(n)));
      EXPECT_NEAR(ready->scattered() / found->scattered(), 1, 1e-5);
      for (uint64_t i = 0; i < 1000; ++i) {
        const Vec3 w = sampleUniformSphere({uniform(i, 0, 0), uniform(i, 0, 1)});
        EXPECT_NEAR(ready->pdf(w), found->pdf(w), 1e-5f * found->pdf(w));
        const float u = uniform(i, 0, 2);
        const Vec2 v(uniform(i, 0, 3), uniform(i, 0, 4));
        NumberSequence a(i), b(i);
        EXPECT_NEAR(length(ready->sample(u, v, a) - found->sample(u, v, b)), 0, 1e-5) << i;
      }
    }
}

TEST(SignificanceCache, PointsThatScatterNothingHaveNoGuide) {
  const FunctionWeight black([](const Vec3&) { return 0.f; }, 0);
  SignificanceCache cache({0.6f, 8, 1000}, kUnitBox);
  teach(cache, kUp, twoPatches, 4);
  EXPECT_FALSE(cache.makeLocal()->moveTo({Vec3(0.4f), kUp, false}, black));
}

TEST(SignificanceCache, IsTheSameForAnyNumberOfThreads) {
  std::vector<float> first;
  for (const int threads : {1, 4}) {
    const ThreadLimit limit(threads);
    SignificanceCache cache({0.1f, 8, 3000}, kUnitBox);
    teach(cache, kUp, twoPatches, 5, 20'000);
    std::vector<float> all;
    for (int i = 0; i < 33; ++i) {
      const float x = 0.01f + 0.03f * static_cast<float>(i);
      for (const auto& l : cache.find(Vec3(x, 1 - x, 0.5f), kUp).lobes) {
        all.push_back(l.flux);
        all.push_back(l.axis.direction.x);
      }
    }
    EXPECT_GT(all.size(), 20u);
    if (first.empty()) first = all;
    EXPECT_EQ(all, first);
  }
}

TEST(SignificanceCache, CellsDivideWhereSamplesAre) {
  SignificanceCache cache({0.9f, 8, 100'000}, kUnitBox);
  teach(cache, kUp, twoPatches, 3, 40'000);
  size_t nodes = 0;
  for (const CellTree& t : cache.trees()) nodes += t.nodes().size();
  EXPECT_GE(nodes, 3 * cache.trees().size());
}

/// Any input, in a scene of one point, and in one 10⁶ units wide.
void stress(int passes, int samplesPerPass) {
  for (const float extent : {0.f, 1e6f}) {
    const int most = 2000;
    SignificanceCache cache({0.1f, 8, most}, Bounds3(Vec3(0), Vec3(extent)));
    const auto local = cache.makeLocal();
    for (int pass = 0; pass < passes; ++pass) {
      std::vector<GuideSample> samples(static_cast<size_t>(samplesPerPass));
      for (size_t i = 0; i < samples.size(); ++i) {
        const auto u = [&](uint32_t d) { return uniform(static_cast<uint64_t>(pass), i, d); };
        GuideSample& s = samples[i];
        s.p = extent * Vec3(u(0), u(1), u(2));
        s.wi = sampleUniformSphere({u(3), u(4)});
        s.n = i % 3 == 0 ? Vec3(0) : faceForward(kUp, s.wi);
        s.pdf = std::pow(10.f, 20 * u(5) - 12);
        s.radiance = i % 5 == 0 ? 0 : std::pow(10.f, 24 * u(6) - 12);
      }
      cache.learn(samples);
      cache.endPass();
      ASSERT_LE(cache.recordCount(), static_cast<size_t>(most));
      ASSERT_LE(cache.memory(), size_t{4} << 20);
      for (int i = 0; i < 20; ++i) {
        const GuideSample& s = samples[static_cast<size_t>(i)];
        if (!local->moveTo({s.p, s.n, i % 2 == 0}, Even(s.n))) continue;
        NumberSequence more(1);
        const Vec3 w = local->sample(0.3f, {0.2f, 0.7f}, more);
        ASSERT_TRUE(isFinite(w));
        ASSERT_GT(local->pdf(w), 0);
        ASSERT_TRUE(std::isfinite(local->pdf(w)));
      }
    }
    EXPECT_GT(cache.recordCount(), 0u) << extent;
  }
}

TEST(SignificanceCache, SurvivesAnything) { stress(100, 2000); }
/// Takes a while.
TEST(SignificanceCache, DISABLED_SurvivesAThousandPassesOfAnything) { stress(1000, 5000); }

}  // namespace

}  // namespace lampyris::test
