// SPDX-License-Identifier: Apache-2.0
#include "media/coefficients.h"

#include "base/measured_media.h"

namespace lampyris {

namespace {

/// pbrt-v3's default: whole milk.
constexpr const char* kDefaultMedium = "Wholemilk";

Rgb checked(const Rgb& c, const char* name, const MediumContext& context) {
  if (!c.isFinite())
    throw SceneError(context.location,
                     std::string("medium: ") + name + " times scale must be finite");
  return c;
}

}  // namespace

void CoefficientParameters::declare(Declaration& d) {
  d.add("preset", preset,
        "Name of a measured medium (in 1/mm), e.g. \"Skimmilk\", for sigma_a and sigma_s.")
      .defaultIs("none")
      .rangeIs("the name of a measured medium, or none");
  d.add("sigma_a", absorption, "Absorption coefficient, in 1/length.")
      .defaultIs("the preset's; 0.0011 0.0024 0.014")
      .atLeast(0);
  d.add("sigma_s", scattering, "Scattering coefficient, in 1/length.")
      .defaultIs("the preset's; 2.55 3.21 3.77")
      .atLeast(0);
  d.add("scale", scale, "Factor on both coefficients.").atLeast(0);
  d.add("g", g, "Mean cosine of scattering: > 0 forwards, < 0 backwards.").range(-0.999, 0.999);
}

MediumCoefficients CoefficientParameters::resolve(const MediumContext& context) const {
  const MeasuredMedium* measured = findMeasuredMedium(preset.empty() ? kDefaultMedium : preset);
  if (!measured) {
    context.diagnostics.warn(context.location, "unknown medium preset \"" + preset + "\"" +
                                                   didYouMean(preset, measuredMediumNames()) +
                                                   ": the default is used");
    measured = findMeasuredMedium(kDefaultMedium);
  }
  MediumCoefficients c;
  c.absorption = checked(absorption.value_or(measured->sigmaA) * scale, "sigma_a", context);
  c.scattering = checked(scattering.value_or(measured->sigmaPrimeS) * scale, "sigma_s", context);
  c.g = g;
  return c;
}

}  // namespace lampyris
