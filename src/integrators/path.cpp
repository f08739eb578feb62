// SPDX-License-Identifier: Apache-2.0
#include "integrators/common_parameters.h"
#include "integrators/path_integrator.h"

namespace lampyris {

namespace {

struct PathParameters {
  PathSettings settings;
  std::string strategy = "one";
  std::string lightSampler;

  void declare(Declaration& d) {
    settings.declare(d);
    d.add("strategy", strategy,
          "Whether one light is sampled at a vertex, or as many as the lights and the BSDF there "
          "are worth.")
        .oneOf({"one", "adaptive"});
    d.add("adaptivevertices", settings.adaptiveVertices,
          "Strategy \"adaptive\": how many vertices of a path are sampled so; later ones take one "
          "sample of each kind.")
        .range(0, 1e6);
    settings.adaptiveSettings.declare(d);
    declareLightSampler(
        d, lightSampler,
        "Which light to sample at a point; see kind lightsampler. Strategy \"adaptive\" takes "
        "\"brdf\" alone.");
  }
};

std::unique_ptr<Integrator> create(const PathParameters& p, const IntegratorContext& context) {
  PathSettings settings = p.settings;
  settings.location = context.location;
  settings.adaptive = p.strategy == "adaptive";
  if (settings.adaptive)
    return makePathIntegrator(settings, makeAdaptiveLights(context, p.lightSampler));
  return makePathIntegrator(settings, context.lightDistribution(p.lightSampler));
}

}  // namespace

IntegratorRegistry::Entry pathPlugin() {
  return makePlugin("path", "Path tracing with one light sampled at each vertex.", create);
}

}  // namespace lampyris
