// SPDX-License-Identifier: Apache-2.0
#include "integrators/path_integrator.h"

namespace lampyris {

namespace {

struct PathParameters {
  PathSettings settings;
  std::string lightSampler;

  void declare(Declaration& d) {
    settings.declare(d);
    d.add("lightsampler", lightSampler, "Which light to sample at a point; see kind lightsampler.")
        .alias("lightsamplestrategy")
        .defaultIs("bvh");
  }
};

std::unique_ptr<Integrator> create(const PathParameters& p, const IntegratorContext& context) {
  PathSettings settings = p.settings;
  settings.location = context.location;
  return makePathIntegrator(settings, context.lightDistribution(p.lightSampler));
}

}  // namespace

IntegratorRegistry::Entry pathPlugin() {
  return makePlugin("path", "Path tracing with one light sampled at each vertex.", create);
}

}  // namespace lampyris
