// SPDX-License-Identifier: Apache-2.0
// Metropolis light transport: its numbers, and its images against path tracing. Pixels of one image
// depend on each other, so what is tested are means over independent images of few mutations.
#include <atomic>

#include "core/parallel.h"
#include "core/sampling.h"
#include "integrator_comparison.h"
#include "integrators/primary_samples.h"

namespace lampyris::test {

namespace {

TEST(PrimarySamples, StepsAreNormalAndKeepNumbersUniform) {
  constexpr float kSigma = 0.05f;
  constexpr int kDimensions = 40, kSteps = 50;
  std::vector<double> moves, squares, numbers, fresh;
  for (uint64_t run = 0; run < 200; ++run) {
    PrimarySamples samples(kDimensions);
    samples.proposeAnew(run);
    for (uint64_t step = 0; step < kSteps; ++step) {
      std::vector<float> before;
      for (uint32_t d = 0; d < kDimensions; ++d) before.push_back(samples.get1D({}, d));
      samples.accept();
      samples.proposeNear(1000 * run + step, kSigma);
      for (uint32_t d = 0; d < kDimensions; ++d) {
        const float x = samples.get1D({}, d);
        ASSERT_TRUE(x >= 0 && x < 1);
        EXPECT_EQ(x, samples.get1D({}, d));
        float move = (x - before[d]) / kSigma;
        if (std::abs(x - before[d]) > 0.5f) move += (x < 0.5f ? 1 : -1) / kSigma;
        moves.push_back(static_cast<double>(move));
        squares.push_back(static_cast<double>(move * move));
      }
    }
    for (uint32_t d = 0; d < kDimensions; ++d)
      numbers.push_back(static_cast<double>(samples.get1D({}, d)));
  }
  EXPECT_EQ(meanTest(moves, 0), "");
  EXPECT_EQ(meanTest(squares, 1), "");
  EXPECT_EQ(meanTest(numbers, 0.5), "");
  for (double& x : numbers) x *= x;
  EXPECT_EQ(meanTest(numbers, 1. / 3), "");
}

TEST(PrimarySamples, ForgetsWhatNobodyAskedForAndRejectsWhole) {
  PrimarySamples samples(4);
  samples.proposeAnew(1);
  const float first = samples.get1D({}, 0);
  samples.accept();
  samples.proposeNear(2, 1e-4f);
  EXPECT_NEAR(samples.get1D({}, 0), first, 1e-3);
  // Number 1 was not asked for: it is drawn as if there were no current point.
  PrimarySamples other(4);
  other.proposeAnew(2);
  EXPECT_EQ(samples.get1D({}, 1), other.get1D({}, 1));
  // Without accept(), proposals start where the current point is.
  samples.proposeNear(3, 1e-4f);
  EXPECT_NEAR(samples.get1D({}, 0), first, 1e-3);
  samples.proposeAnew(3);
  EXPECT_GT(std::abs(samples.get1D({}, 0) - first), 1e-3);
}

TEST(PrimarySamples, SmallStepsKeepTheSeed) {
  PrimarySamples samples(1);
  samples.proposeAnew(1);
  const uint64_t first = samples.steadySeed();
  samples.accept();
  samples.proposeAnew(2);
  EXPECT_NE(samples.steadySeed(), first);
  samples.proposeNear(3, 0.1f);  // number 2 was rejected
  EXPECT_EQ(samples.steadySeed(), first);
}

std::string path(int depth) { return withDepth("path", depth); }

void expectPathsImage(const std::string& world, int depth, TinyView view = roomView("")) {
  TinyView reference = view;
  view.integrator = mlt(depth);
  reference.integrator = path(depth);
  expectSameImage(tinyScene(view, world), tinyScene(reference, world));
}

TEST(Mlt, EqualsPathAtEveryDepth) {
  for (const int depth : {0, 1, 4}) expectPathsImage(room(), depth);
}

TEST(Mlt, ChainsHaveNoStartUpBias) {
  // One mutation for every fourth chain.
  const std::string few =
      R"("mlt" "integer bootstrapsamples" 50 "integer chains" 1000 "integer maxdepth" 2)";
  expectSameImage(tinyScene(roomView(few), room()), tinyScene(roomView(path(2)), room()), 1, 16);
}

TEST(Mlt, EqualsPathForOtherLights) {
  for (const std::string& light : kLightsAbove) expectPathsImage(ballUnder(light), 3);
}

TEST(Mlt, EqualsPathThroughGlass) { expectPathsImage(glassRoom(), 5); }

TEST(Mlt, EqualsPathForEveryCamera) {
  for (const std::string& camera : kCameras) {
    TinyView view = roomView("");
    view.camera = camera;
    expectPathsImage(room(), 3, view);
  }
}

TEST(Mlt, FiltersAndCropWindowsShowPartsOfTheSameImage) {
  const auto text = [](const std::string& integrator) {
    std::string t = tinyScene(roomView(integrator), room());
    t.replace(t.find("\"box\""), 5, R"("gaussian" "float xwidth" 3 "float ywidth" 2)");
    t.insert(t.find("Film \"image\"") + 12, " \"float cropwindow\" [0.2 0.7 0.4 0.9]");
    return t;
  };
  expectSameImage(text(mlt(2)), text(path(2)), 64, 256);
}

TEST(Mlt, LargeStepsAloneAndSmallOnesGiveTheSame) {
  for (const char* steps : {R"( "float largestepprobability" 1)",
                            R"( "float largestepprobability" 0.05 "float sigma" 0.1)"})
    expectSameImage(tinyScene(roomView(mlt(2, steps)), room()),
                    tinyScene(roomView(path(2)), room()));
}

TEST(Mlt, FurnaceOfManyBounces) {
  TinyView view;
  constexpr int kDepth = 12;
  view.integrator = mlt(kDepth);
  view.lookAt = "0 0 0  0 0 1  0 1 0";
  view.camera = R"("perspective" "float fov" 90)";
  std::vector<double> means;
  for (uint64_t seed = 0; seed < 24; ++seed) {
    BuildOptions options;
    options.seed = seed;
    TinyScene scene(tinyScene(view, matte(0.5f) + "AreaLightSource \"diffuse\" \"rgb L\" [1 1 1]\n"
                                                  "ReverseOrientation\nShape \"sphere\"\n"),
                    options);
    scene.render(16);
    double sum = 0;
    for (const double g : scene.greens()) sum += g;
    means.push_back(sum / 64);
  }
  EXPECT_EQ(meanTest(means, 2 - std::pow(0.5, kDepth)), "");
}

TEST(Mlt, ThreadsAndPassesDoNotCount) {
  const std::string text = tinyScene(roomView(mlt(3)), room());
  const auto image = [&text](int threads) {
    const ThreadLimit limit(threads);
    TinyScene scene(text);
    EXPECT_EQ(scene.render(7), 7u);
    return scene.film().save();
  };
  const std::string one = image(1);
  EXPECT_EQ(one, image(2));
  EXPECT_EQ(one, image(5));
}

TEST(Mlt, AnImageIsThereAfterEveryPassAndWhenCancelled) {
  const auto meanOf = [](TinyScene& scene) {
    double sum = 0;
    for (const double g : scene.greens()) sum += g;
    return sum / static_cast<double>(scene.greens().size());
  };
  TinyScene whole(tinyScene(roomView(mlt(2)), room()));
  EXPECT_EQ(whole.render(0), 100u);  // "mutationsperpixel"
  const double mean = meanOf(whole);

  TinyScene scene(tinyScene(roomView(mlt(2)), room()));
  std::atomic<bool> cancel{false};
  RenderOptions options;
  options.sampleCount = 1 << 20;
  options.cancel = &cancel;
  uint64_t last = 0;
  options.onPass = [&](const RenderProgress& p) {
    EXPECT_EQ(p.samplesDone, last == 0 ? 1 : 2 * last);
    last = p.samplesDone;
    if (last >= 8) {
      EXPECT_NEAR(meanOf(scene) / mean, 1, 0.3);
    }
    if (last == 32) cancel = true;
  };
  EXPECT_EQ(scene.render(options), 32u);
  EXPECT_NEAR(meanOf(scene) / mean, 1, 0.3);

  TinyScene none(tinyScene(roomView(mlt(2)), room()));
  EXPECT_EQ(none.render(options), 0u);
  EXPECT_EQ(meanOf(none), 0);
}

TEST(Mlt, BlackScenesEnd) {
  TinyScene scene(tinyScene(roomView(mlt(2)), matte(0.5f) + square(1)));
  EXPECT_EQ(scene.render(3), 3u);
  RenderOptions options;
  options.seconds = 1000;
  EXPECT_EQ(scene.render(options), 0u);
  for (const double g : scene.greens()) EXPECT_EQ(g, 0);
}

TEST(Mlt, ChecksItsParameters) {
  for (const char* wrong : {"\"integer chains\" 0", "\"float sigma\" 0", "\"integer maxdepth\" -1",
                            "\"float largestepprobability\" 1.5"})
    EXPECT_THROW(TinyScene(tinyScene(roomView(std::string("\"mlt\" ") + wrong), "")), SceneError)
        << wrong;
}

}  // namespace

}  // namespace lampyris::test
