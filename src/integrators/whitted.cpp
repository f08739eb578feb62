// SPDX-License-Identifier: Apache-2.0
// Ray tracing after Whitted 1980, "An Improved Illumination Model for Shaded Display", with
// pbrt-v3's extensions: one point of every light, area and infinite ones too.
#include "integrators/direct_lighting_integrator.h"

namespace lampyris {

namespace {

struct WhittedParameters {
  DirectLightingSettings settings;
  void declare(Declaration& d) { settings.declare(d); }
};

std::unique_ptr<Integrator> create(const WhittedParameters& p, const IntegratorContext& context) {
  DirectLightingSettings settings = p.settings;
  settings.location = context.location;
  return makeDirectLightingIntegrator(settings, LightStrategy::EachOnce, {});
}

}  // namespace

IntegratorRegistry::Entry whittedPlugin() {
  return makePlugin("whitted", "As directlighting, with one sample of every light at a point.",
                    create);
}

}  // namespace lampyris
