// SPDX-License-Identifier: Apache-2.0
/// What the parameters of all media have in common.
#pragma once

#include <string>

#include "base/medium.h"

namespace lampyris {

/// In 1/length of the scene, per channel.
struct MediumCoefficients {
  Rgb absorption, scattering;
  float g = 0;
  Rgb extinction() const { return absorption + scattering; }
};

struct CoefficientParameters {
  std::string preset;
  std::optional<Rgb> absorption, scattering;
  float scale = 1, g = 0;

  void declare(Declaration& d);
  /// Warns of an unknown preset. Throws SceneError for coefficients that are negative or not
  /// finite.
  MediumCoefficients resolve(const MediumContext& context) const;
};

}  // namespace lampyris
