// SPDX-License-Identifier: Apache-2.0
/// Integrators held against each other on a small room.
#pragma once

#include <gtest/gtest.h>

#include "support/statistics.h"
#include "support/tiny_scenes.h"

namespace lampyris::test {

/// A room with two emitters, a point light, matte and glossy surfaces.
inline std::string room() {
  return "LightSource \"point\" \"point from\" [0.5 0.5 1] \"rgb I\" [0.4 0.4 0.4]\n"
         "AttributeBegin\nAreaLightSource \"diffuse\" \"rgb L\" [4 4 4]\nTranslate -0.5 0.2 1.5\n"
         "Rotate 180 1 0 0\n" +
         square(0.3f) +
         "AttributeEnd\n"
         "AttributeBegin\nAreaLightSource \"diffuse\" \"rgb L\" [20 20 20]\nTranslate 0.6 -0.4 "
         "0.5\nShape \"sphere\" \"float radius\" 0.05\nAttributeEnd\n" +
         matte(0.7f) + square(2) + "AttributeBegin\nTranslate 0 0 2\n" + square(2) +
         "AttributeEnd\n"
         "Material \"plastic\" \"float roughness\" 0.1\n"
         "AttributeBegin\nTranslate -0.2 -0.3 0.3\nShape \"sphere\" \"float radius\" "
         "0.3\nAttributeEnd\n";
}

inline TinyView roomView(const std::string& integrator) {
  TinyView v;
  v.integrator = integrator;
  v.lookAt = "0 -1.8 1  0 0 0.6  0 0 1";
  v.camera = R"("perspective" "float fov" 60)";
  v.resolution = 16;
  return v;
}

/// The pixels of two renders with different seeds differ by noise only.
inline void expectSameMean(const TinyView& a, const TinyView& b, const std::string& world,
                           uint64_t samples, uint64_t otherSamples = 0) {
  TinyScene one(tinyScene(a, world));
  BuildOptions otherSeed;
  otherSeed.seed = 77;
  TinyScene two(tinyScene(b, world), otherSeed);
  one.render(samples);
  two.render(otherSamples > 0 ? otherSamples : samples);
  EXPECT_EQ(one.badSamples() + two.badSamples(), 0);
  std::vector<double> difference = one.greens();
  const auto other = two.greens();
  double mean = 0;
  for (size_t i = 0; i < difference.size(); ++i) difference[i] -= other[i], mean += other[i];
  EXPECT_GT(mean, 0);
  EXPECT_EQ(meanTest(difference, 0), "") << a.integrator << " against " << b.integrator;
}
inline void expectSameMean(const std::string& a, const std::string& b, const std::string& world,
                           uint64_t samples) {
  expectSameMean(roomView(a), roomView(b), world, samples);
}

}  // namespace lampyris::test
