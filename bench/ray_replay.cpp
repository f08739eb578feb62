// SPDX-License-Identifier: Apache-2.0
/// How much rendering costs beyond its rays: renders a scene on one thread, records every ray that
/// the integrator traces, replays them through bare Embree in the same order, and prints the ratio.
///
/// usage: ray_replay SCENE.pbrt [ROUNDS] [-D key=value …]
#include <embree3/rtcore.h>
#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <ctime>
#include <limits>
#include <string>

#include "accelerators/embree_geometry.h"
#include "core/huge_pages.h"
#include "core/parallel.h"
#include "scene/builder.h"

namespace lampyris {
namespace {

/// Seconds that this process has computed: what else the machine does counts less.
double now() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

struct RecordedRay {
  Ray ray;
  bool occlusion;
};

/// Passes rays on and keeps a copy of each.
class RecordingGeometry final : public Geometry {
 public:
  RecordingGeometry(std::unique_ptr<Geometry> inner, std::vector<RecordedRay>& rays)
      : inner_(std::move(inner)), rays_(rays) {}
  std::optional<Hit> intersect(const Ray& ray) const override {
    rays_.push_back({ray, false});
    return inner_->intersect(ray);
  }
  bool occluded(const Ray& ray) const override {
    rays_.push_back({ray, true});
    return inner_->occluded(ray);
  }
  SurfaceInteraction surface(const Ray& ray, const Hit& hit, SurfaceDetail detail) const override {
    return inner_->surface(ray, hit, detail);
  }
  const Primitive& primitive(const Hit& hit) const override { return inner_->primitive(hit); }
  Bounds3 bounds() const override { return inner_->bounds(); }
  std::unique_ptr<Geometry> release() { return std::move(inner_); }

 private:
  std::unique_ptr<Geometry> inner_;
  std::vector<RecordedRay>& rays_;
};

/// Traces the rays; returns the number that hit, so that nothing is optimised away.
size_t replay(RTCScene scene, const std::vector<RecordedRay>& rays) {
  size_t hits = 0;
  RTCIntersectContext context;
  rtcInitIntersectContext(&context);
  for (const RecordedRay& r : rays) {
    RTCRayHit q;
    q.ray.org_x = r.ray.o.x, q.ray.org_y = r.ray.o.y, q.ray.org_z = r.ray.o.z;
    q.ray.dir_x = r.ray.d.x, q.ray.dir_y = r.ray.d.y, q.ray.dir_z = r.ray.d.z;
    q.ray.tnear = 0, q.ray.tfar = r.ray.tMax, q.ray.time = 0;
    q.ray.mask = ~0u, q.ray.id = 0, q.ray.flags = 0;
    if (r.occlusion) {
      rtcOccluded1(scene, &context, &q.ray);
      hits += q.ray.tfar < 0;
    } else {
      q.hit.geomID = RTC_INVALID_GEOMETRY_ID;
      q.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
      rtcIntersect1(scene, &context, &q);
      hits += q.hit.geomID != RTC_INVALID_GEOMETRY_ID;
    }
  }
  return hits;
}

int run(int argc, char** argv) {
  BuildOptions options;
  std::string path;
  int rounds = 5;
  for (int i = 1; i < argc; ++i) {
    const std::string arg = argv[i];
    if (arg == "-D" && i + 1 < argc) {
      const std::string pair = argv[++i];
      const size_t eq = pair.find('=');
      options.overrides.emplace_back(pair.substr(0, eq), pair.substr(eq + 1));
    } else if (path.empty()) {
      path = arg;
    } else {
      rounds = std::stoi(arg);
    }
  }
  if (path.empty()) {
    fmt::print("usage: ray_replay SCENE.pbrt [ROUNDS] [-D key=value ...]\n");
    return 2;
  }
  const ThreadLimit oneThread(1);
  SourceFiles files;
  Diagnostics diagnostics(files, [](const std::string& text) { fmt::print("{}\n", text); });
  Statistics statistics;
  const auto job = loadScene(path, options, files, diagnostics, statistics);
  gatherIntoHugePages();
  uint64_t sample = 0;
  const auto renderOneSample = [&] {
    RenderContext context{job->scene, *job->camera, *job->sampler, *job->film, {}, statistics};
    context.options.firstSample = sample;
    context.options.sampleCount = ++sample;
    const double start = now();
    job->integrator->render(context);
    return now() - start;
  };

  std::vector<RecordedRay> rays;
  const RTCScene embree = embreeScene(*job->scene.geometry);
  auto recorder = std::make_unique<RecordingGeometry>(std::move(job->scene.geometry), rays);
  RecordingGeometry& recording = *recorder;
  job->scene.geometry = std::move(recorder);
  renderOneSample();
  job->scene.geometry = recording.release();

  const auto paths = static_cast<double>(job->film->bounds().area());
  const auto closest = static_cast<double>(
      std::count_if(rays.begin(), rays.end(), [](const RecordedRay& r) { return !r.occlusion; }));
  const auto total = static_cast<double>(rays.size());
  fmt::print("{:.0f} camera paths, {:.2f} closest hits and {:.2f} occlusion tests a path\n", paths,
             closest / paths, (total - closest) / paths);
  // The least times: other work on the machine only adds.
  double render = std::numeric_limits<double>::infinity(), replayed = render;
  size_t hits = 0;
  for (int i = 0; i < rounds; ++i) {
    render = std::min(render, renderOneSample());
    const double start = now();
    hits = replay(embree, rays);
    replayed = std::min(replayed, now() - start);
  }
  fmt::print(
      "render {:.0f} paths/s, replay {:.0f} paths/s ({} hits), render/replay {:.2f} "
      "(least times of {})\n",
      paths / render, paths / replayed, hits, render / replayed, rounds);
  return 0;
}

}  // namespace
}  // namespace lampyris

int main(int argc, char** argv) {
  try {
    return lampyris::run(argc, argv);
  } catch (const std::exception& e) {
    fmt::print(stderr, "{}\n", e.what());
    return 1;
  }
}
