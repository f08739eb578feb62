// SPDX-License-Identifier: Apache-2.0
#include "lights/pattern_light.h"

#include <cmath>

#include "lights/emission.h"
#include "lights/point_sample.h"

namespace lampyris {

void PatternLightParameters::declare(Declaration& d) {
  declareColor(d, "I", intensity, "Radiant intensity (W/sr) where the image is white.", scale);
  d.add("mapname", map, "The image; values are taken as linear. Without one it is white.")
      .rangeIs("any file name, or none");
}

PatternLight::PatternLight(const PatternLightParameters& parameters, const LightContext& context,
                           const std::string& name)
    : lightToWorld_(context.lightToWorld),
      worldToLight_(context.lightToWorld.inverse()),
      p_(context.lightToWorld.point(Vec3(0))),
      intensity_(emittedColor(parameters.intensity, parameters.scale, context)) {
  if (lightToWorld_.isSingular())
    throw SceneError(context.location,
                     "the " + name + " light's transform has no inverse (a scale of 0?)");
  if (!parameters.map.empty())
    image_ = EmissionImage::load(parameters.map, EmissionImage::Encoding::Linear, context.images,
                                 context);
}

std::optional<LightSample> PatternLight::sample(uint32_t, const Vec3& from, const Vec2&) const {
  return samplePoint(p_, from, [this](const Vec3& w) {
    return intensity_ * pattern(normalize(worldToLight_.vector(w)));
  });
}

std::optional<EmissionSample> PatternLight::sampleEmission(uint32_t, const Vec2&,
                                                           const Vec2& v) const {
  return emission_.emit(p_, v, [this](const Vec3& w) {
    return intensity_ * pattern(normalize(worldToLight_.vector(w)));
  });
}

EmissionPdf PatternLight::emissionPdf(uint32_t, const Vec3&, const Vec3& w) const {
  return {1, emission_.pdf(w)};
}

double PatternLight::stretch(const Vec3& w) const {
  // In double: the squares of very small or large scales are beyond float.
  const double ratio =
      glm::length(glm::dvec3(w)) / glm::length(glm::dvec3(lightToWorld_.vector(w)));
  return ratio * ratio * ratio;
}

LightBounds PatternLight::boundsOf(const Rgb& meanPattern) const {
  LightBounds b;
  b.box = Bounds3(p_);
  b.intensity = (intensity_ * meanPattern).luminance();
  return b;
}

}  // namespace lampyris
