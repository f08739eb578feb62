// SPDX-License-Identifier: Apache-2.0
/// Scattering that was measured: media that scene files name.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "core/rgb.h"

namespace lampyris {

/// Per millimetre. Scattering is reduced: that of an equal medium which scatters alike in all
/// directions.
struct MeasuredMedium {
  std::string_view name;
  Rgb sigmaPrimeS, sigmaA;
};

/// Null if there is none of that name.
const MeasuredMedium* findMeasuredMedium(std::string_view name);
std::vector<std::string> measuredMediumNames();

}  // namespace lampyris
