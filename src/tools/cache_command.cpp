// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <CLI/CLI.hpp>

#include "scene/builder.h"
#include "tools/cache_picture.h"
#include "tools/commands.h"
#include "tools/with_scene.h"

namespace lampyris {

namespace {

struct CacheSettings {
  std::string scene, out = "cache.png";
  uint64_t samples = 32;
  float dim = 0.25f;
};

Image dimmed(const Film& film, float factor) {
  const PixelBounds b = film.bounds();
  const Int2 size = b.max - b.min;
  Image image(size.x, size.y, 3);
  for (int y = 0; y < size.y; ++y)
    for (int x = 0; x < size.x; ++x) image.setRgb(x, y, film.pixel(b.min + Int2(x, y)) * factor);
  return image;
}

void draw(const CacheSettings& s, SourceFiles& files, Diagnostics& diagnostics) {
  BuildOptions build;
  build.overrides = {{"integrator", "guidedpath"}};
  Statistics statistics;
  const auto job = loadScene(s.scene, build, files, diagnostics, statistics);
  if (!job->camera->projects())
    throw SceneError({}, "records can be drawn for perspective cameras only");
  std::vector<LearnedDirection> found;
  RenderOptions options;
  options.sampleCount = s.samples;
  options.onPass = [&found](const RenderProgress& p) {
    if (p.learned) found = p.learned->directions();
  };
  RenderContext context{job->scene, *job->camera, *job->sampler, *job->film, options, statistics};
  job->integrator->render(context);
  Image image = dimmed(*job->film, s.dim);
  const size_t drawn =
      drawDirections(image, job->film->bounds().min, job->scene, *job->camera, found);
  writeImageFile(s.out, image);
  for (const char* name : {"records", "cells", "memory (bytes)", "look-ups",
                           "share of directions with a guide", "seconds of learning"})
    fmt::print("{:<34}{:.6g}\n", name, statistics.value("guide", name));
  fmt::print("{:<34}{}\n", "records in the picture", drawn);
}

}  // namespace

int runCache(const Arguments& arguments) {
  CacheSettings s;
  CLI::App app("What a guided render has learned, drawn over the image.", "lampyris cache");
  app.add_option("SCENE", s.scene, "Scene file")->required();
  app.add_option("-o,--out", s.out, "Picture to write")->capture_default_str();
  app.add_option("--spp", s.samples, "Samples a pixel to learn from")
      ->check(CLI::Range(1, 1 << 20))
      ->capture_default_str();
  app.add_option("--dim", s.dim, "Brightness of the image below")
      ->check(CLI::Range(0., 1.))
      ->capture_default_str();
  if (const auto code = parseArguments(app, arguments)) return *code;
  if (!isWritableImagePath(s.out))
    throw UsageError(fmt::format("--out: \"{}\" is no image that can be written", s.out));
  return withScene(
      false, [&s](SourceFiles& files, Diagnostics& diagnostics) { draw(s, files, diagnostics); });
}

}  // namespace lampyris
