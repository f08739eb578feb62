// SPDX-License-Identifier: Apache-2.0
#include "integrators/bidirectional.h"
#include "integrators/common_parameters.h"

namespace lampyris {

namespace {

struct BdptParameters {
  int maxDepth = 5;
  std::vector<int> pixelBounds;
  std::string lightSampler;

  void declare(Declaration& d) {
    // Every pair of vertices is connected: more bounces than this would never end.
    d.add("maxdepth", maxDepth, "Longest path, in bounces.").range(0, 1000);
    declarePixelBounds(d, pixelBounds);
    declareLightSampler(
        d, lightSampler,
        "Which light to sample at a vertex of the camera's path; see kind lightsampler. Paths "
        "from lights start by power.");
    for (const char* name : {"visualizestrategies", "visualizeweights"})
      d.ignored(name, "no images of single strategies are written");
  }
};

class FilmSplats final : public SplatSink {
 public:
  explicit FilmSplats(Film& film) : film_(film) {}
  void splat(const Vec2& at, const Rgb& value) override { film_.addSplat(at, value); }

 private:
  Film& film_;
};

/// Counts each sample's path from the lights.
class CountingEstimator final : public RadianceEstimator {
 public:
  CountingEstimator(const RadianceEstimator& inner, Film& film) : inner_(inner), film_(film) {}
  Rgb radiance(const CameraRay& camera, SampleStream& stream, RenderState& state) const override {
    film_.addLightPaths(1);
    return inner_.radiance(camera, stream, state);
  }

 private:
  const RadianceEstimator& inner_;
  Film& film_;
};

class BdptIntegrator final : public Integrator {
 public:
  BdptIntegrator(BdptParameters parameters, SourceLocation location,
                 std::unique_ptr<LightDistribution> distribution)
      : parameters_(std::move(parameters)),
        location_(location),
        distribution_(std::move(distribution)) {}

  uint64_t render(RenderContext& context) const override {
    const PixelBounds pixels = renderedPixels(context.film, parameters_.pixelBounds, location_);
    FilmSplats splats(context.film);
    const BidirectionalEstimator estimator(context, parameters_.maxDepth, distribution_.get(),
                                           pixels, splats);
    if (!context.camera.projects()) return renderPasses(context, pixels, estimator);
    context.film.openLightImage(
        typicalSample(context, parameters_.maxDepth, distribution_.get(), pixels));
    return renderPasses(context, pixels, CountingEstimator(estimator, context.film));
  }

 private:
  const BdptParameters parameters_;
  const SourceLocation location_;
  const std::unique_ptr<LightDistribution> distribution_;
};

std::unique_ptr<Integrator> create(const BdptParameters& p, const IntegratorContext& context) {
  return std::make_unique<BdptIntegrator>(p, context.location,
                                          context.lightDistribution(p.lightSampler));
}

}  // namespace

IntegratorRegistry::Entry bdptPlugin() {
  return makePlugin("bdpt", "Bidirectional path tracing: paths from the camera and from lights.",
                    create);
}

}  // namespace lampyris
