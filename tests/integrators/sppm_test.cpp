// SPDX-License-Identifier: Apache-2.0
// Stochastic progressive photon mapping.
#include <set>

#include "core/sampling.h"
#include "integrator_comparison.h"
#include "integrators/photon_map.h"

namespace lampyris::test {

namespace {

TEST(PhotonMap, FindsAllWithinTheRadiusOnce) {
  for (const float scale : {1e-6f, 1.f, 1e6f}) {
    std::vector<Photon> photons;
    for (uint64_t i = 0; i < 3000; ++i) {
      Photon p;
      p.p = scale * Vec3(uniform(1, i, 0), uniform(1, i, 1), 0.1f * uniform(1, i, 2));
      p.power = Rgb(static_cast<float>(i));
      photons.push_back(p);
    }
    const float radius = 0.07f * scale;
    const PhotonMap map(photons, radius);
    for (uint64_t i = 0; i < 50; ++i) {
      const Vec3 at = scale * Vec3(uniform(2, i, 0), uniform(2, i, 1), 0.05f);
      std::multiset<float> found, expected;
      map.search(at, [&](const Photon& p) { found.insert(p.power.g); });
      for (const Photon& p : photons)
        if (lengthSquared(p.p - at) <= radius * radius) expected.insert(p.power.g);
      EXPECT_EQ(found, expected);
    }
  }
  int visits = 0;
  PhotonMap({}, 1).search(Vec3(0), [&](const Photon&) { ++visits; });
  EXPECT_EQ(visits, 0);
}

double meanOf(const std::string& integrator, const std::string& world, uint64_t samples) {
  TinyScene scene(tinyScene(roomView(integrator), world));
  scene.render(samples);
  EXPECT_EQ(scene.badSamples(), 0);
  double sum = 0;
  for (const double g : scene.greens()) sum += g;
  return sum / static_cast<double>(scene.greens().size());
}

TEST(Sppm, ApproachesThePathsImage) {
  // No emitter is seen, whose noise would hide all else.
  const std::string world =
      "LightSource \"point\" \"point from\" [0.5 0.5 1] \"rgb I\" [0.4 0.4 0.4]\n" + matte(0.7f) +
      square(2) + "AttributeBegin\nTranslate 0 0 2\n" + square(2) + "AttributeEnd\n";
  const std::string sppm =
      R"("sppm" "float radius" 0.1 "integer photonsperiteration" 5000 "integer iterations" 40)";
  const double path = meanOf(R"("path" "integer maxdepth" 12)", world, 512);
  EXPECT_NEAR(meanOf(sppm + " \"integer maxdepth\" 12", world, 0) / path, 1, 0.02);
}

TEST(Sppm, DirectLightIsThatOfThePath) {
  // Photons count from their second surface on; with a depth of one there is none.
  expectSameMean(R"("sppm" "integer maxdepth" 1)", R"("path" "integer maxdepth" 1)", room(), 128);
}

TEST(Sppm, CausticsAreGathered) {
  const std::string world =
      "LightSource \"point\" \"point from\" [0.5 0.3 1.5] \"rgb I\" [1 1 1]\n" + matte(0.6f) +
      square(2) +
      "Material \"glass\"\nAttributeBegin\nTranslate 0 0 0.5\nShape \"sphere\" \"float radius\" "
      "0.3\nAttributeEnd\n";
  // "path" cannot find what a point light sends through glass.
  const double with = meanOf(R"("sppm" "float radius" 0.05 "integer iterations" 10)", world, 0);
  const double without = meanOf(R"("path")", world, 64);
  EXPECT_GT(with, 1.02 * without);
}

TEST(Sppm, IterationsAreSamples) {
  const std::string text = tinyScene(
      roomView(R"("sppm" "integer numiterations" 5 "integer photonsperiteration" 500)"), room());
  TinyScene whole(text), first(text), second(text);
  EXPECT_EQ(whole.render(), 5u);
  first.render(2);
  ASSERT_TRUE(second.film().restore(first.film().save()));
  RenderOptions options;
  options.firstSample = 2;
  EXPECT_EQ(second.render(options), 5u);
  EXPECT_EQ(whole.film().save(), second.film().save());
  EXPECT_THROW(TinyScene(tinyScene(roomView("\"sppm\" \"float radius\" 0"), "")), SceneError);
}

}  // namespace

}  // namespace lampyris::test
