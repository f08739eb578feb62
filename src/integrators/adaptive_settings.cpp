// SPDX-License-Identifier: Apache-2.0
#include "integrators/adaptive_direct.h"

namespace lampyris {

void AdaptiveSettings::declare(Declaration& d) {
  d.add(
       "maxbrdfsamples", maxSamples,
       "Adaptive direct lighting: the most samples by the BSDF and by lights in its lobes together "
       "at a glossy point; it takes this times the largest integral of its lobes over a cluster "
       "of lights.")
      .range(1, kMostSamples);
  d.add("brdfallocation", allocation,
        "Adaptive direct lighting: how these samples are shared out. Adaptive: by how often BSDF "
        "samples find light; equal: half of either; lights, bsdf: all of one kind.")
      .oneOf({"adaptive", "equal", "lights", "bsdf"});
}

BrdfAllocation AdaptiveSettings::how() const {
  return allocation == "equal"    ? BrdfAllocation::Equal
         : allocation == "lights" ? BrdfAllocation::Lights
         : allocation == "bsdf"   ? BrdfAllocation::Bsdf
                                  : BrdfAllocation::Adaptive;
}

std::unique_ptr<LightDistribution> makeAdaptiveLights(const IntegratorContext& context,
                                                      const std::string& name) {
  auto lights = context.lightDistribution(name.empty() ? "brdf" : name);
  if (!dynamic_cast<const BrdfLightDistribution*>(lights.get()))
    throw SceneError(context.location,
                     "strategy \"adaptive\" needs \"string lightsampler\" "
                     "\"brdf\", the only one that knows glossy lobes");
  return lights;
}

}  // namespace lampyris
