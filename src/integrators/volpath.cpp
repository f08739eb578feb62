// SPDX-License-Identifier: Apache-2.0
#include "integrators/common_parameters.h"
#include "integrators/volume_path.h"

namespace lampyris {

namespace {

struct VolpathParameters {
  PathSettings settings;
  std::string lightSampler;

  void declare(Declaration& d) {
    settings.declare(d);
    declareLightSampler(d, lightSampler);
  }
};

class VolpathIntegrator final : public Integrator {
 public:
  VolpathIntegrator(const PathSettings& settings, std::unique_ptr<LightDistribution> distribution)
      : settings_(settings), distribution_(std::move(distribution)) {}

  uint64_t render(RenderContext& context) const override {
    const PixelBounds pixels =
        renderedPixels(context.film, settings_.pixelBounds, settings_.location);
    const Guidance none;
    const VolumePathEstimator estimator(context.scene, settings_, distribution_.get(), none);
    return renderPasses(context, pixels, estimator);
  }
  bool rendersMedia() const override { return true; }

 private:
  const PathSettings settings_;
  const std::unique_ptr<LightDistribution> distribution_;
};

std::unique_ptr<Integrator> create(const VolpathParameters& p, const IntegratorContext& context) {
  PathSettings settings = p.settings;
  settings.location = context.location;
  return std::make_unique<VolpathIntegrator>(settings, context.lightDistribution(p.lightSampler));
}

}  // namespace

IntegratorRegistry::Entry volpathPlugin() {
  return makePlugin("volpath", "Path tracing through participating media.", create);
}

}  // namespace lampyris
