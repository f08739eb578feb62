// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "base/light.h"
#include "base/light_distribution.h"

namespace lampyris {
namespace {

class DarkLight final : public Light {
 public:
  explicit DarkLight(uint32_t elements) : elements_(elements) {}
  uint32_t elementCount() const override { return elements_; }
  bool isDelta() const override { return true; }
  std::optional<LightSample> sample(uint32_t, const Vec3&, const Vec2&) const override {
    return {};
  }
  Rgb power(uint32_t) const override { return Rgb(); }
  std::optional<LightBounds> bounds(uint32_t) const override { return {}; }

 private:
  uint32_t elements_;
};

TEST(LightTable, GivesEachElementAnId) {
  const DarkLight a(1), mesh(1000), none(0), b(1);
  LightTable table;
  EXPECT_EQ(table.add(&a), 0u);
  EXPECT_EQ(table.add(&mesh), 1u);
  EXPECT_EQ(table.add(&none), 1001u);
  EXPECT_EQ(table.add(&b), 1001u);
  EXPECT_EQ(table.size(), 1002u);
  EXPECT_EQ(table[0].light, &a);
  EXPECT_EQ(table[1].light, &mesh);
  EXPECT_EQ(table[1].element, 0u);
  EXPECT_EQ(table[1000].light, &mesh);
  EXPECT_EQ(table[1000].element, 999u);
  EXPECT_EQ(table[1001].light, &b);
  EXPECT_EQ(table[1001].element, 0u);
  EXPECT_EQ(table.objectCount(), 4u);
  EXPECT_EQ(table.firstId(1), 1u);
}

TEST(LightTable, OfSingleLightsAndOfNone) {
  const DarkLight none(0), a(1), b(1);
  LightTable single, late;
  EXPECT_EQ(single.add(&a), 0u);
  EXPECT_EQ(single.add(&b), 1u);
  EXPECT_EQ(single.size(), 2u);
  EXPECT_EQ(single[0].light, &a);
  EXPECT_EQ(single[1].light, &b);
  EXPECT_EQ(single[1].element, 0u);
  EXPECT_EQ(late.add(&none), 0u);
  EXPECT_EQ(late.add(&a), 0u);
  EXPECT_EQ(late.add(&b), 1u);
  EXPECT_EQ(late[1].light, &b);
}

TEST(LightTable, FindsSingleLightsWhereverTheyLie) {
  constexpr size_t kCount = 3000;
  const std::vector<DarkLight> sideBySide(kCount, DarkLight(1));
  std::vector<const DarkLight*> odd;  // two out of their rows
  odd.reserve(kCount);
  for (const DarkLight& light : sideBySide) odd.push_back(&light);
  std::swap(odd[1500], odd[2900]);
  LightTable rows, disturbed, backwards, late;
  for (size_t i = 0; i < kCount; ++i) {
    rows.add(&sideBySide[i]);
    disturbed.add(odd[i]);
    backwards.add(&sideBySide[kCount - 1 - i]);
    late.add(&sideBySide[i]);
  }
  const DarkLight mesh(7);
  late.add(&mesh);
  for (LightId id = 0; id < kCount; ++id) {
    EXPECT_EQ(rows[id].light, &sideBySide[id]);
    EXPECT_EQ(disturbed[id].light, odd[id]);
    EXPECT_EQ(backwards[id].light, &sideBySide[kCount - 1 - id]);
    EXPECT_EQ(late[id].light, &sideBySide[id]);
  }
  EXPECT_EQ(late[kCount + 6].element, 6u);
}

class FixedDistribution final : public LightDistribution {
 public:
  std::optional<SampledLight> sample(const LightSampleContext&, float) const override {
    return SampledLight{3, 0.25f};
  }
  float pmf(const LightSampleContext&, LightId light) const override {
    return light == 3 ? 0.25f : 0;
  }
};

TEST(LightDistribution, DefaultCutIsOneSample) {
  const FixedDistribution d;
  SampledLights cut;
  d.sampleCut({}, 0.5f, cut);
  ASSERT_EQ(cut.size(), 1u);
  EXPECT_EQ(cut[0].light, 3u);
  EXPECT_EQ(cut[0].pmf, d.expectedCount({}, 3));
}

}  // namespace
}  // namespace lampyris
