// SPDX-License-Identifier: Apache-2.0
#include "integrators/common_parameters.h"
#include "integrators/mlt_renderer.h"

namespace lampyris {

namespace {

struct MltParameters {
  int maxDepth = 5, bootstrapSamples = 100000, chains = 1000, mutationsPerPixel = 100;
  float largeStepProbability = 0.3f, sigma = 0.01f;
  std::string lightSampler;

  void declare(Declaration& d) {
    d.add("maxdepth", maxDepth, "Longest path, in bounces.").range(0, 1000);
    d.add("bootstrapsamples", bootstrapSamples,
          "Paths of each number of bounces that tell the image's brightness and start chains.")
        .range(1, 1e8);
    d.add("chains", chains, "Markov chains.").range(1, 1e6);
    d.add("mutationsperpixel", mutationsPerPixel, "Mutations, in relation to the film's pixels.")
        .range(1, 1 << 30);
    d.add("largestepprobability", largeStepProbability,
          "How often a mutation draws a new path, independent of the one before.")
        .range(1e-6, 1);
    d.add("sigma", sigma, "Standard deviation of all other mutations, of numbers in [0, 1).")
        .range(1e-6, 1);
    declareVertexLightSampler(d, lightSampler);
  }
};

class MltIntegrator final : public Integrator {
 public:
  MltIntegrator(const MltSettings& settings, std::unique_ptr<LightDistribution> distribution)
      : settings_(settings), distribution_(std::move(distribution)) {}

  uint64_t render(RenderContext& context) const override {
    return MltRenderer(context, distribution_.get(), settings_).render();
  }
  bool rendersMedia() const override { return true; }
  double memory(const Film& film) const override {
    return Film::kLightImagePixelBytes * static_cast<double>(film.bounds().area()) +
           MltRenderer::memory(settings_);
  }
  bool resumes() const override { return false; }
  std::string_view partsDiffer() const override {
    return "each part has chains of its own, from the same bootstrap paths";
  }
  bool samplesPixels() const override { return false; }

 private:
  const MltSettings settings_;
  const std::unique_ptr<LightDistribution> distribution_;
};

std::unique_ptr<Integrator> create(const MltParameters& p, const IntegratorContext& context) {
  const MltSettings settings{p.maxDepth,
                             static_cast<uint64_t>(p.bootstrapSamples),
                             static_cast<size_t>(p.chains),
                             static_cast<uint64_t>(p.mutationsPerPixel),
                             p.largeStepProbability,
                             p.sigma,
                             context.seed};
  return std::make_unique<MltIntegrator>(settings, context.lightDistribution(p.lightSampler));
}

}  // namespace

IntegratorRegistry::Entry mltPlugin() {
  return makePlugin("mlt", "Metropolis light transport: chains of bidirectional paths.", create);
}

}  // namespace lampyris
