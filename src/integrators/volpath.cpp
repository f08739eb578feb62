// SPDX-License-Identifier: Apache-2.0
#include "integrators/common_parameters.h"
#include "integrators/pixel_integrator.h"
#include "integrators/volume_path.h"

namespace lampyris {

namespace {

struct VolpathParameters : PathSettings {
  std::string lightSampler;

  void declare(Declaration& d) {
    PathSettings::declare(d);
    declareLightSampler(d, lightSampler);
  }
};

class VolpathIntegrator final : public PixelIntegrator<VolpathParameters> {
 public:
  using PixelIntegrator::PixelIntegrator;
  bool rendersMedia() const override { return true; }

 private:
  uint64_t renderPixels(RenderContext& context, const PixelBounds& pixels) const override {
    const Guidance none;
    const VolumePathEstimator estimator(context.scene, parameters_, distribution_.get(), none);
    return renderPasses(context, pixels, estimator);
  }
};

}  // namespace

IntegratorRegistry::Entry volpathPlugin() {
  return makePlugin("volpath", "Path tracing through participating media.",
                    createPixelIntegrator<VolpathIntegrator, VolpathParameters>);
}

}  // namespace lampyris
