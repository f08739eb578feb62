// SPDX-License-Identifier: Apache-2.0
#include "integrators/bidirectional.h"
#include "integrators/common_parameters.h"
#include "integrators/pixel_integrator.h"

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
    declareVertexLightSampler(d, lightSampler);
    for (const char* name : {"visualizestrategies", "visualizeweights"})
      d.ignored(name, "no images of single strategies are written");
  }
};

constexpr uint64_t kTypicalSamples = 256;

class FilmSplats final : public SplatSink {
 public:
  explicit FilmSplats(Film& film) : film_(film) {}
  void splat(const Splat& s) override { film_.addSplat(s.film, s.value); }

 private:
  Film& film_;
};

class SplatSum final : public SplatSink {
 public:
  void splat(const Splat& s) override { sum += static_cast<double>(s.value.luminance()); }
  double sum = 0;
};

/// Everything but the paths that the light's side leads to the camera itself: those go into the
/// light image.
class BdptEstimator final : public RadianceEstimator {
 public:
  BdptEstimator(const RenderContext& context, int maxDepth, const LightDistribution* distribution,
                const PixelBounds& pixels)
      : paths_(context, distribution, pixels), maxDepth_(maxDepth), film_(context.film) {}

  Rgb radiance(const CameraRay& camera, SampleStream& stream, RenderState& state) const override {
    FilmSplats splats(film_);
    film_.addLightPaths(1);
    return paths_.all(maxDepth_, camera, stream, state, splats);
  }
  double typicalSample(const RenderContext& context, const PixelBounds& pixels) const;

 private:
  const BidirectionalPaths paths_;
  const int maxDepth_;
  Film& film_;
};

/// About the mean of a sample's radiance and splats, the same whenever it is asked for: for
/// Film::openLightImage(). From a few samples, spread over `pixels`.
double BdptEstimator::typicalSample(const RenderContext& context, const PixelBounds& pixels) const {
  SplatSum splats;
  const auto count = static_cast<uint64_t>(pixels.area());
  const uint64_t stride = count / kTypicalSamples + 1;
  RenderState state;
  double sum = 0;
  for (uint64_t i = 0; i < kTypicalSamples; ++i) {
    // NOLINTNEXTLINE(clang-analyzer-core.DivideZero): renderedPixels() are at least one.
    const uint64_t at = i * stride, pixel = at % count;
    const Int2 offset(static_cast<int>(pixel % static_cast<uint64_t>(pixels.size().x)),
                      static_cast<int>(pixel / static_cast<uint64_t>(pixels.size().x)));
    SampleStream stream(context.sampler, {pixels.min + offset, at / count});
    CameraSample sample;
    sample.film = Vec2(pixels.min + offset) + stream.next2D();
    sample.lens = stream.next2D();
    sample.time = stream.next1D();
    const CameraRay camera = context.camera.generate(sample);
    const auto y =
        static_cast<double>(paths_.all(maxDepth_, camera, stream, state, splats).luminance());
    if (std::isfinite(y)) sum += std::abs(y);
  }
  const double typical = (sum + splats.sum) / kTypicalSamples;
  return typical > 0 && std::isfinite(typical) ? typical : 1;
}

class BdptIntegrator final : public PixelIntegrator<BdptParameters> {
 public:
  using PixelIntegrator::PixelIntegrator;
  bool rendersMedia() const override { return true; }
  double memory(const Film& film) const override {
    return Film::kLightImagePixelBytes * static_cast<double>(film.bounds().area());
  }

 private:
  uint64_t renderPixels(RenderContext& context, const PixelBounds& pixels) const override {
    const BdptEstimator estimator(context, parameters_.maxDepth, distribution_.get(), pixels);
    if (context.camera.projects())
      context.film.openLightImage(estimator.typicalSample(context, pixels));
    return renderPasses(context, pixels, estimator);
  }
};

}  // namespace

IntegratorRegistry::Entry bdptPlugin() {
  return makePlugin("bdpt", "Bidirectional path tracing: paths from the camera and from lights.",
                    createPixelIntegrator<BdptIntegrator, BdptParameters>);
}

}  // namespace lampyris
