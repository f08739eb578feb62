// SPDX-License-Identifier: Apache-2.0
#include "core/frame.h"
#include "light_trees.h"

namespace lampyris::test {
namespace {

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
    cone.cosThetaE = std::cos(static_cast<double>(random(i, 4)) * 3.1415);
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
    EXPECT_LE(n.cosThetaE(), static_cast<float>(cone.cosThetaE) + 1e-6f);
    EXPECT_GE(n.cosThetaE(), static_cast<float>(cone.cosThetaE) - 2e-4f);
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
    a.cosThetaE = 0.9, b.cosThetaE = 0.5;
    a.twoSided = i % 5 == 0, b.twoSided = i % 7 == 0;
    const EmissionCone m = merge(a, b);
    EXPECT_EQ(m.cosThetaE, 0.5);
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

/// Emission factors are means: over all directions they give the flux that went in.
TEST(LightBVHNode, ClustersKeepTheirFlux) {
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

TEST(EmissionCone, MeanCosine) {
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

}  // namespace
}  // namespace lampyris::test
