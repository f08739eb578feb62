// SPDX-License-Identifier: Apache-2.0
/// The lights of a scene and their tree, in figures.
#pragma once

#include <array>
#include <string>

#include "accelerators/light_bvh_report.h"
#include "base/light.h"

namespace lampyris {

/// Lights by what they are to a light sampler.
enum class LightKind : uint8_t {
  Point,     ///< a position, no surface, emits all around
  Spot,      ///< a position, no surface, emits within a cone
  Area,      ///< the elements of emitting surfaces
  Distant,   ///< one direction
  Infinite,  ///< all directions
};
inline constexpr std::array<const char*, 5> kLightKinds = {"point", "spot", "area", "distant",
                                                           "infinite"};

struct LightReport {
  struct Kind {
    size_t objects = 0, lights = 0;
    double power = 0;  ///< luminance of the sum, W
  };
  std::array<Kind, kLightKinds.size()> kinds{};
  size_t lights = 0;

  /// Of the lights with a position: luminance of the power, W.
  struct Flux {
    double total = 0, least = 0, median = 0, most = 0;
    double brightestShare = 0;  ///< of the 1 % that emit most
    double effective = 0;       ///< e^entropy of the shares: as many equal lights are as spread out
  } flux;
  LightTreeReport tree;
};

/// Looks at the lights of a table and at the tree made of them.
LightReport reportLights(const LightTable& lights, const LightBVHAccel& tree);

/// For people: some lines.
std::string formatLightReport(const LightReport& report);
/// For programs: a JSON object.
std::string lightReportJson(const LightReport& report);

}  // namespace lampyris
