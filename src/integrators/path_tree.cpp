// SPDX-License-Identifier: Apache-2.0
// The integrator name of scenes made for "Light Bounding Volume Hierarchies" (Ma 2018), whose
// "lightsamplestrategy" is a threshold for splitting the tree into a cut.
#include <charconv>

#include "integrators/path_integrator.h"

namespace lampyris {

namespace {

struct PathTreeParameters {
  PathSettings settings;
  std::string strategy = "1.0";

  void declare(Declaration& d) {
    settings.declare(d);
    d.add("lightsamplestrategy", strategy,
          "A number in [0, 1] as text: the threshold of tree splitting (1: never); or the name of "
          "a light sampler.")
        .alias("lightsampler")
        .rangeIs("0 to 1, or a name of kind lightsampler");
  }
};

std::unique_ptr<Integrator> create(const PathTreeParameters& p, const IntegratorContext& context) {
  PathSettings settings = p.settings;
  settings.location = context.location;
  const char* const end = p.strategy.data() + p.strategy.size();
  float threshold = 1;
  const auto [next, error] = std::from_chars(p.strategy.data(), end, threshold);
  const bool number = error == std::errc() && next == end;
  if (!number) return makePathIntegrator(settings, context.lightDistribution(p.strategy));
  if (!(threshold >= 0 && threshold <= 1))
    throw SceneError(context.location,
                     "parameter \"lightsamplestrategy\": expected a number in "
                     "[0, 1] or the name of a light sampler, got \"" +
                         p.strategy + "\"");
  return makePathIntegrator(settings,
                            context.lightDistribution("bvh", {{"splitthreshold", p.strategy}}));
}

}  // namespace

IntegratorRegistry::Entry pathTreePlugin() {
  return makePlugin("pathtree", "Path tracing with lights drawn from the light tree.", create);
}

}  // namespace lampyris
