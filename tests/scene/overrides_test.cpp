// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "scene_test.h"

namespace lampyris::test {
namespace {

BuildOptions with(std::vector<std::pair<std::string, std::string>> overrides) {
  BuildOptions o;
  o.overrides = std::move(overrides);
  return o;
}

TEST(Overrides, ReplaceParameters) {
  Reader r;
  const auto job = r.build(world(""), with({{"film.xresolution", "16"},
                                            {"film.filename", "other.exr"},
                                            {"integrator.maxdepth", "2"},
                                            {"camera.fov", "20"},
                                            {"filter.xwidth", "1"},
                                            {"integrator.lightsampler", "power"}}));
  EXPECT_EQ(job->film->resolution(), Int2(16, 4));
  EXPECT_EQ(job->film->filename(), "other.exr");
  EXPECT_EQ(job->film->filter().radius().x, 1);
}

TEST(Overrides, ReplacePlugins) {
  Reader r;
  const std::string options =
      "Sampler \"halton\" \"integer pixelsamples\" 4 \"bool samplepixelcenter\" \"false\" "
      "Integrator \"path\" \"float rrthreshold\" 2 ";
  const auto job =
      r.build(options + world(""), with({{"sampler", "random"}, {"integrator", "directlighting"}}));
  EXPECT_EQ(job->sampler->samplesPerPixel(), 4);
  EXPECT_TRUE(r.warnings.empty()) << r.warnings[0];
  r.build(world("LightSource \"point\" LightSource \"point\""), with({{"lightsampler", "power"}}));
  r.build(world(""), with({{"filter", "gaussian"}, {"filter.alpha", "3"}}));
}

TEST(Overrides, SamplesSeedOutputAndCrop) {
  BuildOptions o;
  o.samplesPerPixel = 3;
  o.outputPath = "x.pfm";
  o.cropWindow = {0, .5f, .5f, 1};
  Reader r;
  const auto job = r.build(world(""), o);
  EXPECT_EQ(job->sampler->samplesPerPixel(), 3);
  EXPECT_EQ(job->film->filename(), "x.pfm");
  EXPECT_EQ(job->film->bounds(), (PixelBounds{{0, 2}, {4, 4}}));
}

TEST(Overrides, Errors) {
  const auto error = [](const std::string& key, const std::string& value) {
    return buildError(world(""), with({{key, value}}));
  };
  EXPECT_EQ(
      error("integator.maxdepth", "3"),
      "-D integator.maxdepth: unknown kind \"integator\"; did you mean \"integrator\"?; it is "
      "one of integrator, sampler, film, camera, filter, lightsampler");
  EXPECT_EQ(error("film.", "3"), "-D film.: expected kind.parameter=value or kind=plugin");
  EXPECT_EQ(error("film.xresolutio", "3")
                .find("-D film.xresolutio: unknown parameter; did you mean \"xresolution\"?; there "
                      "are: xresolution, yresolution"),
            0u);
  EXPECT_EQ(error("film.xresolution", "3.5"), "-D xresolution: \"3.5\" is not an integer");
  EXPECT_EQ(error("sampler", "rndom"), "unknown sampler \"rndom\"; did you mean \"random\"?");
  EXPECT_EQ(error("lightsampler", "bvhh"), "unknown lightsampler \"bvhh\"; did you mean \"bvh\"?");
  EXPECT_NE(error("lightsampler.nosuch", "1").find("unknown parameter"), std::string::npos);
}

}  // namespace
}  // namespace lampyris::test
