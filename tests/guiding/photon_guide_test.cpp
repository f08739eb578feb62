// SPDX-License-Identifier: Apache-2.0
#include "guiding/photon_guide.h"

#include <gtest/gtest.h>

#include "core/sampling.h"
#include "function_weight.h"
#include "support/statistics.h"

namespace lampyris::test {

namespace {

const Vec3 kUp = normalize(Vec3(0.3f, -0.5f, 1));

FunctionWeight Tilted() {
  return FunctionWeight([](const Vec3& wi) { return std::max(0.f, dot(wi, kUp)) * (1.5f + wi.x); });
}

std::vector<GuidePhoton> photonsFrom(bool (*lit)(const Vec3&), size_t count) {
  std::vector<GuidePhoton> photons;
  for (uint64_t i = 0; photons.size() < count; ++i) {
    const auto u = [&](uint32_t d) { return uniform(1, i, d); };
    const Vec3 wi = sampleUniformSphere({u(0), u(1)});
    if (lit(wi)) photons.push_back({Vec3(u(2), u(3), u(4)), wi, 0.5f + u(5)});
  }
  return photons;
}

TEST(PhotonTree, FindsTheNearest) {
  const auto photons = photonsFrom([](const Vec3&) { return true; }, 777);
  const PhotonTree tree(photons);
  for (uint64_t k = 0; k < 50; ++k) {
    const Vec3 p(1.4f * uniform(2, k, 0) - 0.2f, uniform(2, k, 1), uniform(2, k, 2));
    for (const size_t wanted : {size_t{1}, size_t{50}, size_t{1000}}) {
      std::vector<PhotonTree::Near> found(wanted);
      found.resize(tree.nearest(p, found));
      std::vector<float> expected, got;
      for (const GuidePhoton& photon : photons) expected.push_back(lengthSquared(photon.p - p));
      for (const PhotonTree::Near& n : found) {
        got.push_back(n.squaredDistance);
        EXPECT_EQ(n.squaredDistance, lengthSquared(tree[n.photon].p - p));
      }
      std::sort(expected.begin(), expected.end());
      std::sort(got.begin(), got.end());
      expected.resize(std::min(wanted, expected.size()));
      EXPECT_EQ(got, expected);
    }
  }
}

TEST(PhotonGuide, SamplingMatchesItsPdf) {
  const PhotonGuide guide({}, photonsFrom([](const Vec3& w) { return w.z > 0 && w.x > 0; }, 3000));
  const auto local = guide.makeLocal();
  ASSERT_TRUE(local->moveTo({Vec3(0.5f), kUp, false}, Tilted()));
  EXPECT_LT(local->pdf(normalize(Vec3(-1, 0, 0.6f))), 0.01f);
  DirectionTest test;
  test.samples = 100'000;
  test.subdivisions = 64;
  test.sample = [&](const Vec2& u, float uc, Vec3& w) {
    NumberSequence more(1);
    w = local->sample(uc, u, more);
    return true;
  };
  test.pdf = [&](const Vec3& w) { return static_cast<double>(local->pdf(w)); };
  EXPECT_EQ(directionChiSquareTest(test), "");
}

TEST(PhotonGuide, KnowsNothingOfMediaAndDarkness) {
  const PhotonGuide guide({}, photonsFrom([](const Vec3& w) { return dot(w, kUp) < 0; }, 100));
  EXPECT_FALSE(guide.makeLocal()->moveTo({Vec3(0.5f), kUp, false}, Tilted()));
  EXPECT_FALSE(guide.makeLocal()->moveTo({Vec3(0.5f), Vec3(0), false}, Tilted()));
  EXPECT_FALSE(PhotonGuide({}, {}).makeLocal()->moveTo({Vec3(0.5f), kUp, false}, Tilted()));
}

}  // namespace

}  // namespace lampyris::test
