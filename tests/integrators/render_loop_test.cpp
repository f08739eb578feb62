// SPDX-License-Identifier: Apache-2.0
#include "integrators/render_loop.h"

#include <gtest/gtest.h>

#include <chrono>
#include <limits>
#include <thread>

#include "core/parallel.h"
#include "integrators/registry.h"
#include "lightdistributions/registry.h"
#include "support/tiny_scenes.h"

namespace lampyris::test {

namespace {

const std::string kWorld =
    "LightSource \"infinite\" \"rgb L\" [1 2 3]\n"
    "LightSource \"point\" \"point from\" [0 1 2]\n" +
    matte(0.6f) + square(1) + "Translate 0.2 0 0.3\nShape \"sphere\" \"float radius\" 0.3\n";

/// To be put before the world, so that the camera is within, too.
const std::string kFog =
    "MakeNamedMedium \"fog\" \"string type\" \"heterogeneous\" \"rgb sigma_s\" [0.5 0.4 0.3] "
    "\"integer nx\" 1 \"integer ny\" 1 \"integer nz\" 2 \"point p0\" [-2 -2 -1] \"point p1\" [2 2 "
    "3] \"float density\" [0.2 0.9]\nMediumInterface \"fog\" \"fog\"\n";

TinyView view(const std::string& integrator = "\"path\"") {
  TinyView v;
  v.integrator = integrator;
  v.camera = R"("orthographic" "float screenwindow" [-1.2 1.2 -1.2 1.2])";
  v.resolution = 33;
  return v;
}

std::string rendered(int threads, const std::string& scene) {
  const ThreadLimit limit(threads);
  TinyScene tiny(scene);
  EXPECT_EQ(tiny.render(7), 7u);
  return tiny.film().save();
}

TEST(RenderLoop, ThreadsDoNotChangeABit) {
  std::vector<std::string> integrators{R"("guidedpath" "string guide" "photons")"};
  for (const auto& plugin : integratorRegistry().entries()) {
    integrators.push_back('"' + plugin.name + '"');
    if (plugin.schema.find("bootstrapsamples"))
      integrators.back() += " \"integer bootstrapsamples\" 10000";
  }
  for (const auto& plugin : lightDistributionRegistry().entries())
    integrators.push_back("\"path\" \"string lightsampler\" \"" + plugin.name + "\"");
  for (const std::string& integrator : integrators)
    for (const std::string& world : {kWorld, kFog + kWorld}) {
      const std::string scene = tinyScene(view(integrator), world), one = rendered(1, scene);
      for (const int threads : {2, 3, 8, 64})
        EXPECT_TRUE(rendered(threads, scene) == one) << threads << " threads:\n" << scene;
    }
}

TEST(RenderLoop, SeedsChangeTheImage) {
  TinyScene one(tinyScene(view(), kWorld));
  BuildOptions options;
  options.seed = 1;
  TinyScene two(tinyScene(view(), kWorld), options);
  one.render(2);
  two.render(2);
  EXPECT_NE(one.film().save(), two.film().save());
}

TEST(RenderLoop, ResumingGivesTheSameBits) {
  TinyScene whole(tinyScene(view(), kWorld)), first(tinyScene(view(), kWorld)),
      second(tinyScene(view(), kWorld));
  whole.render(11);
  first.render(4);
  ASSERT_TRUE(second.film().restore(first.film().save()));
  RenderOptions options;
  options.firstSample = 4;
  options.sampleCount = 11;
  EXPECT_EQ(second.render(options), 11u);
  EXPECT_EQ(whole.film().save(), second.film().save());
}

TEST(RenderLoop, CancelledRendersGoOnToTheSameBits) {
  TinyScene whole(tinyScene(view(), kWorld)), part(tinyScene(view(), kWorld));
  whole.render(40);
  std::atomic<bool> cancel{false};
  RenderOptions options;
  options.sampleCount = 40;
  options.cancel = &cancel;
  // Falls into the middle of a pass: some pixels are then ahead of others.
  options.onPass = [&](const RenderProgress& p) { cancel = p.samplesDone >= 8; };
  const uint64_t done = part.render(options);
  EXPECT_EQ(done, 8u);
  cancel = false;
  options.onPass = {};
  options.firstSample = done;
  EXPECT_EQ(part.render(options), 40u);
  EXPECT_EQ(whole.film().save(), part.film().save());
}

/// Cancels from within a pass.
class CancellingEstimator final : public RadianceEstimator {
 public:
  explicit CancellingEstimator(std::atomic<bool>* cancel) : cancel_(cancel) {}
  Rgb radiance(const CameraRay&, SampleStream& stream, RenderState&) const override {
    if (cancel_ && stream.address().index == 3 && stream.address().pixel == Int2(20, 20))
      *cancel_ = true;
    return Rgb(stream.next1D());
  }

 private:
  std::atomic<bool>* cancel_;
};

TEST(RenderLoop, CancelWithinAPassKeepsEachPixelsCount) {
  const auto render = [](TinyScene& scene, std::atomic<bool>* cancel, uint64_t first) {
    RenderOptions options;
    options.firstSample = first;
    options.sampleCount = 9;
    options.cancel = cancel;
    RenderContext context{
        scene.job().scene, *scene.job().camera, *scene.job().sampler, scene.film(),
        options,           scene.statistics()};
    return renderPasses(context, scene.film().bounds(), CancellingEstimator(cancel));
  };
  TinyScene whole(tinyScene(view(), kWorld)), part(tinyScene(view(), kWorld));
  EXPECT_EQ(render(whole, nullptr, 0), 9u);
  std::atomic<bool> cancel{false};
  const uint64_t done = render(part, &cancel, 0);
  EXPECT_EQ(done, 2u);
  uint64_t ahead = 0;
  for (int y = 0; y < 33; ++y)
    for (int x = 0; x < 33; ++x) {
      EXPECT_GE(part.film().sampleCount({x, y}), done);
      ahead += part.film().sampleCount({x, y}) > done;
    }
  EXPECT_GT(ahead, 0u);
  EXPECT_EQ(render(part, nullptr, done), 9u);
  EXPECT_EQ(whole.film().save(), part.film().save());
}

TEST(RenderLoop, TimeLimitLeavesNoPixelMoreThanOneSampleAhead) {
  TinyScene scene(tinyScene(view(), kWorld));
  RenderOptions options;
  options.seconds = 0.02;
  const uint64_t done = scene.render(options);
  EXPECT_GE(done, 1u);
  uint64_t sum = 0;
  for (int y = 0; y < 33; ++y)
    for (int x = 0; x < 33; ++x) {
      const uint64_t count = scene.film().sampleCount({x, y});
      EXPECT_TRUE(count == done || count == done + 1) << count;
      sum += count;
    }
  EXPECT_DOUBLE_EQ(scene.statistics().value("render", "samples per pixel"),
                   static_cast<double>(sum) / (33 * 33));
  // Going on levels them, to the same bits as a render at once.
  options = {};
  options.firstSample = done;
  options.sampleCount = done + 3;
  EXPECT_EQ(scene.render(options), done + 3);
  EXPECT_EQ(scene.statistics().value("render", "samples per pixel"), static_cast<double>(done + 3));
  TinyScene whole(tinyScene(view(), kWorld));
  whole.render(done + 3);
  EXPECT_EQ(whole.film().save(), scene.film().save());
}

TEST(RenderLoop, StopsShowTheImageOfThatManySamples) {
  TinyScene scene(tinyScene(view(), kWorld));
  RenderOptions options;
  options.sampleCount = 12;
  options.stops = {{5, 0}, {0, 1e-9}, {12, 0}, {13, 0}};
  std::vector<size_t> met;
  options.onStop = [&](size_t stop, const RenderProgress& p) {
    met.push_back(stop);
    if (stop == 1) return;
    EXPECT_EQ(p.meanSamples, static_cast<double>(options.stops[stop].samples));
    TinyScene other(tinyScene(view(), kWorld));
    other.render(p.samplesDone);
    EXPECT_EQ(other.film().save(), scene.film().save());
  };
  scene.render(options);
  EXPECT_EQ(met, (std::vector<size_t>{1, 0, 2}));
}

TEST(RenderLoop, ClockStandsStillWhileOthersLook) {
  TinyScene scene(tinyScene(view(), kWorld));
  RenderOptions options;
  options.sampleCount = 4;
  options.onPass = [](const RenderProgress&) {
    std::this_thread::sleep_for(std::chrono::milliseconds(60));
  };
  const auto start = std::chrono::steady_clock::now();
  scene.render(options);
  const double all =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  // 4 samples are three passes: 1, 1 and 2.
  EXPECT_LE(scene.statistics().value("render", "seconds"), all - 3 * 0.06);
}

TEST(RenderLoop, RendersToANoise) {
  TinyScene scene(tinyScene(view(), kWorld));
  RenderOptions options;
  options.noise = 0.02;
  const uint64_t done = scene.render(options);
  EXPECT_GE(done, 16u);
  EXPECT_LE(scene.film().noise(), 0.02);
  // A sample less for each eight is above it, so no more were taken than needed.
  TinyScene fewer(tinyScene(view(), kWorld));
  if (done > 16) {
    fewer.render(done - done / 8 - 1);
    EXPECT_GT(fewer.film().noise(), 0.02);
  }
}

TEST(RenderLoop, PassesAreReportedInOrder) {
  TinyScene scene(tinyScene(view(), kWorld));
  RenderOptions options;
  options.sampleCount = 10;
  uint64_t last = 0;
  options.onPass = [&](const RenderProgress& p) {
    EXPECT_GT(p.samplesDone, last);
    EXPECT_EQ(p.samplesTarget, 10u);
    EXPECT_NEAR(p.fractionDone, static_cast<double>(p.samplesDone) / 10, 1e-12);
    EXPECT_EQ(p.cameraPaths, 33 * 33 * p.samplesDone);
    last = p.samplesDone;
  };
  scene.render(options);
  EXPECT_EQ(last, 10u);
  EXPECT_EQ(scene.statistics().value("render", "camera paths"), 33 * 33 * 10);
  EXPECT_GT(scene.statistics().value("render", "shadow rays"), 0);
}

TEST(RenderLoop, PixelBoundsLimitWhatIsRendered) {
  TinyScene scene(tinyScene(view("\"path\" \"integer pixelbounds\" [3 9 20 22]"), kWorld));
  scene.render(2);
  for (int y = 0; y < 33; ++y)
    for (int x = 0; x < 33; ++x)
      EXPECT_EQ(scene.film().sampleCount({x, y}), x >= 3 && x < 9 && y >= 20 && y < 22 ? 2u : 0u);
  for (const char* wrong : {"[1 2 3]", "[9 3 20 22]", "[100 101 0 5]"}) {
    EXPECT_THROW(
        {
          TinyScene bad(
              tinyScene(view("\"path\" \"integer pixelbounds\" " + std::string(wrong)), kWorld));
          bad.render(1);
        },
        SceneError)
        << wrong;
  }
}

class BadEstimator final : public RadianceEstimator {
 public:
  Rgb radiance(const CameraRay&, SampleStream& stream, RenderState&) const override {
    const SampleAddress& a = stream.address();
    if (a.index == 1 && a.pixel == Int2(5, 6)) return Rgb(std::numeric_limits<float>::quiet_NaN());
    if (a.index == 1 && a.pixel == Int2(7, 6)) return Rgb(kInfinity, 0, 0);
    if (a.index == 0 && a.pixel.y == 30) return Rgb(1, -1, 1);
    return Rgb(1);
  }
};

TEST(RenderLoop, BadSamplesAreCountedAndNamed) {
  TinyScene scene(tinyScene(view(), kWorld));
  RenderOptions options;
  options.sampleCount = 3;
  RenderContext context{scene.job().scene, *scene.job().camera, *scene.job().sampler, scene.film(),
                        options,           scene.statistics()};
  renderPasses(context, scene.film().bounds(), BadEstimator());
  EXPECT_EQ(scene.statistics().value("bad samples", "not a number"), 1);
  EXPECT_EQ(scene.statistics().value("bad samples", "infinite"), 1);
  EXPECT_EQ(scene.statistics().value("bad samples", "negative"), 33);
  std::string list;
  for (const auto& e : scene.statistics().entries())
    if (e.section == "bad samples" && !e.text.empty()) list = e.text;
  EXPECT_TRUE(list.starts_with("0,30 #0; 1,30 #0; ")) << list;
  EXPECT_TRUE(list.ends_with("9,30 #0")) << list;
  for (const Rgb& c : scene.pixels()) EXPECT_TRUE(c.isFinite() && c.r >= 0 && c.g >= 0);
}

}  // namespace

}  // namespace lampyris::test
