// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "core/parameters.h"
#include "textures/noise.h"

namespace lampyris {

/// The parameters of textures made of octaves of noise.
struct OctaveParameters {
  Octaves octaves;

  void declare(Declaration& d) {
    d.add("octaves", octaves.count, "How many frequencies of noise are summed, at most.")
        .range(0, kMostOctaves);
    d.add("roughness", octaves.roughness, "Amplitude of a frequency in relation to the last one.")
        .any();
  }
};

}  // namespace lampyris
