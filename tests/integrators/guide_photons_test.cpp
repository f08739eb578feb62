// SPDX-License-Identifier: Apache-2.0
#include "integrators/guide_photons.h"

#include <gtest/gtest.h>

#include <cmath>

#include "support/tiny_scenes.h"

namespace lampyris::test {

namespace {

constexpr float kReflectance = 1e-4f;
const std::string kWalls =
    "AttributeBegin\n" + matte(kReflectance) +
    "Shape \"trianglemesh\" \"integer indices\" [0 1 2 0 2 3 4 6 5 4 7 6 0 4 5 0 5 1 1 5 6 1 6 2 2 "
    "6 7 2 7 3 3 7 4 3 4 0] \"point P\" [-2 -2 -2 2 -2 -2 2 2 -2 -2 2 -2 -2 -2 2 2 -2 2 2 2 2 -2 "
    "2 2]\nAttributeEnd\n";

/// A small mirror ball receives (1 − √(1 − r²/d²)) / 2 of a lamp's power and sends all of it on to
/// walls that are nearly black: one photon of 40 would meet it, were none aimed.
TEST(GuidePhotons, AreAimedAtMirrorsWithoutChangingTheirPower) {
  TinyScene scene(tinyScene(
      TinyView(), R"(LightSource "point" "point from" [0 0 1.5] "rgb I" [3 3 3])" + kWalls +
                      R"(Material "mirror" "rgb Kr" [1 1 1] Shape "sphere" "float radius" 0.5)"));
  constexpr int kCount = 400000;
  const auto photons = traceGuidePhotons(scene.job().scene, kCount, 2);
  const double all = 4 * static_cast<double>(kPi) * 3;
  const double share = (1 - std::sqrt(1 - 0.25 / 2.25)) / 2;
  double power = 0;
  size_t reflected = 0;
  for (const GuidePhoton& p : photons) {
    power += static_cast<double>(p.power);
    reflected +=
        static_cast<double>(p.power) > 10 * static_cast<double>(kReflectance) * all / kCount;
  }
  EXPECT_NEAR(power / all, share, 0.03 * share);
  EXPECT_GT(reflected, kCount / 15);
}

}  // namespace

}  // namespace lampyris::test
