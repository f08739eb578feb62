// SPDX-License-Identifier: Apache-2.0
/// The contract of light distributions where lights lie and shine as badly as they can, for both
/// forms of the light BVH.
#include "light_trees.h"

namespace lampyris::test {
namespace {

struct Arrangement {
  const char* name;
  /// Position in units of the scene, and intensity.
  Vec3 (*position)(size_t i);
  float (*intensity)(size_t i);
};
float one(size_t) { return 1; }
float anything(size_t i) { return 0.01f + random(i, 4); }
Vec3 anywhere(size_t i) { return randomPoint(i); }

const Arrangement kArrangements[] = {
    {"anywhere", anywhere, anything},
    {"at one place", [](size_t) { return Vec3(1, 2, 3); }, anything},
    {"on a line", [](size_t i) { return Vec3(random(i, 0), 1, 2); }, one},
    {"on a slanted line", [](size_t i) { return Vec3(random(i, 0)) + Vec3(0, 1, 2); }, one},
    {"on a plane", [](size_t i) { return Vec3(random(i, 0), 1, random(i, 1)); }, one},
    {"NaN, infinite, zero or negative power among others", anywhere,
     [](size_t i) {
       const float bad[] = {1, std::nanf(""), 0, kInfinity, -1};
       return bad[i % 5];
     }},
    {"geometric series of places",
     [](size_t i) { return Vec3(std::pow(0.8f, static_cast<float>(i % 400)), 0, 0); }, one},
    {"geometric series of intensities", anywhere,
     [](size_t i) { return std::pow(0.5f, static_cast<float>(i % 100)); }},
    {"one light as strong as a million millions", anywhere,
     [](size_t i) { return i == 0 ? 1e12f : 1.f; }},
    {"far from the origin", [](size_t i) { return Vec3(1e5f, -1e5f, 7e4f) + randomPoint(i); },
     anything},
    {"two clusters far apart", [](size_t i) { return Vec3(i % 2 ? 1e6f : 0.f) + randomPoint(i); },
     anything},
};

Lights arrange(const Arrangement& a, size_t count, float scale) {
  Lights lights(count);
  for (size_t i = 0; i < count; ++i) {
    lights[i].id = static_cast<LightId>(i);
    lights[i].bounds.box = Bounds3(a.position(i) * scale);
    lights[i].bounds.intensity = a.intensity(i);
  }
  return lights;
}

bool counts(const LightBVHInput& l) {
  return l.bounds.intensity > 0 && std::isfinite(l.bounds.intensity);
}

/// Receivers among, near and far from the lights.
std::vector<LightSampleContext> receivers(const Arrangement& a, float scale, uint64_t count) {
  std::vector<LightSampleContext> all;
  for (uint64_t k = 0; k < count; ++k) {
    const Vec3 p =
        a.position(k * 17) + randomDirection(k, 60) * std::pow(10.f, static_cast<float>(k % 4) - 2);
    const Vec3 n = randomDirection(k, 62);
    all.push_back(k % 3 ? volumeAt(p * scale) : opaqueAt(p * scale, n));
  }
  return all;
}

/// What sample() draws, and what that has to do with pmf().
template <class Tree>
void checkDraws(const Tree& tree, const Lights& lights, const LightSampleContext& c, int draws) {
  const LightReceiver at(c);
  for (int k = 0; k < draws; ++k) {
    const double u = refineVariate((static_cast<float>(k) + 0.5f) / static_cast<float>(draws), c.p);
    const auto s = tree.sample(at, u);
    if (!s) {
      ASSERT_FALSE(c.transmits) << "a point light reaches everything in a volume";
      continue;
    }
    ASSERT_LT(s->light, lights.size());
    ASSERT_TRUE(counts(lights[s->light]));
    ASSERT_TRUE(s->pmf > 0 && s->pmf <= 1);
    ASSERT_EQ(s->pmf, tree.pmf(at, s->light));
  }
  ASSERT_TRUE(std::isfinite(tree.rootImportance(at)));
}

/// Σ pmf, and that no light is lost.
template <class Tree>
void checkMass(const Tree& tree, const Lights& lights, const LightSampleContext& c) {
  const auto pmf = pmfs(tree, c, lights.size());
  bool any = false;
  for (const LightBVHInput& l : lights) {
    const Vec3 d = l.bounds.box.min - c.p;
    if (!counts(l)) {
      ASSERT_EQ(pmf[l.id], 0);
    } else if (d != Vec3(0) && permitted(c, d)) {
      ASSERT_GT(pmf[l.id], 0) << l.id;
      any = true;
    }
  }
  const double sum = sumOf(pmf);
  ASSERT_LE(sum, 1 + 1e-4);
  if (any && c.transmits) {
    ASSERT_NEAR(sum, 1, 1e-4);
  }
}

template <class Tree>
class DegenerateLights : public LightTree<Tree> {};
TYPED_TEST_SUITE(DegenerateLights, LightTreeForms);

TYPED_TEST(DegenerateLights, KeepTheContractAtAnyScale) {
  for (const Arrangement& a : kArrangements)
    for (const float scale : {1e-4f, 1.f, 1e4f})
      for (const size_t count : {1, 2, 9, 100, 1500}) {
        SCOPED_TRACE(testing::Message() << count << " lights " << a.name << ", scale " << scale);
        const Lights lights = arrange(a, count, scale);
        const TypeParam tree = TestFixture::build(lights);
        ASSERT_EQ(tree.stats().lights,
                  static_cast<size_t>(std::count_if(lights.begin(), lights.end(), counts)));
        for (const LightSampleContext& c : receivers(a, scale, count > 1000 ? 4 : 12)) {
          checkDraws(tree, lights, c, 60);
          checkMass(tree, lights, c);
          if (this->HasFatalFailure()) return;
        }
      }
}

/// Both forms at once, since the build of the first takes most of the time.
TEST(DegenerateLights, ManyKeepTheContract) {
  for (const Arrangement& a : kArrangements) {
    SCOPED_TRACE(a.name);
    const Lights lights = arrange(a, 30'000, 1);
    const LightBVHAccel binary(lights);
    EXPECT_LE(binary.stats().depth, 96u);
    EXPECT_LE(binary.stats().bytes, 68 * lights.size());
    const WideLightBVH wide(binary);
    for (const LightSampleContext& c : receivers(a, 1, 6)) {
      checkDraws(binary, lights, c, 100);
      checkDraws(wide, lights, c, 100);
      if (HasFatalFailure()) return;
    }
  }
}

TEST(DegenerateLights, AMillionKeepTheContract) {
  for (const size_t which : {1, 8}) {
    const Arrangement& a = kArrangements[which];
    SCOPED_TRACE(a.name);
    const Lights lights = arrange(a, 1'000'000, 1);
    const LightBVHAccel binary(lights);
    EXPECT_LE(binary.stats().depth, 96u);
    const WideLightBVH wide(binary);
    for (const LightSampleContext& c : receivers(a, 1, 6)) {
      checkDraws(binary, lights, c, 100);
      checkDraws(wide, lights, c, 100);
      if (HasFatalFailure()) return;
      if (!c.transmits) continue;
      for (LightId l = 0; l < lights.size(); l += 997) {
        ASSERT_GT(binary.pmf(LightReceiver(c), l), 0);
        ASSERT_GT(wide.pmf(LightReceiver(c), l), 0);
      }
    }
  }
}

}  // namespace
}  // namespace lampyris::test
